#include "commands.h"
#include "numpy_file.h"
#include "scene_setup.h"

#include <koksma/film/atomic_file.h>

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <fstream>
#include <functional>

namespace koksma {

namespace {

/// Calls `row` with each point in order, in batches.
void draw(const PointsCommand& command, const Registry& registry, const std::function<void(std::span<const float>)>& row) {
    const auto factory = make_sampler(registry, command.sampler);
    if (command.dims > factory->info().max_dimensions)
        throw UsageError(fmt::format("sampler '{}' has {} dimensions; {} were asked for", factory->name(), factory->info().max_dimensions, command.dims));
    if (command.n == 0) throw UsageError("--n must be at least 1");
    std::vector<std::uint8_t> arities(command.dims / 2, 2);
    if (command.dims % 2 == 1) arities.push_back(1);
    const Pixel pixel = command.pixel.empty() ? Pixel{} : Pixel{command.pixel[0], command.pixel[1]};
    if (pixel.x < 0 || pixel.y < 0) throw UsageError("--pixel must not be negative");
    const SamplingPlan plan{.film_width = pixel.x + 1, .film_height = pixel.y + 1, .spp = command.n, .seed = command.seed, .layout = plain_layout(arities)};
    const auto source = factory->bind(plan);
    const std::size_t batch = std::clamp<std::size_t>((1u << 20) / command.dims, 1, 4096);
    std::vector<SampleId> ids(batch);
    std::vector<float> values(batch * command.dims), point(command.dims);
    for (std::uint64_t first = 0; first < command.n; first += batch) {
        const auto n = static_cast<std::size_t>(std::min<std::uint64_t>(batch, command.n - first));
        for (std::size_t i = 0; i < n; ++i) ids[i] = {pixel, first + i};
        source->fill(std::span(ids).first(n), plan.layout.slots(), values.data(), batch);
        for (std::size_t i = 0; i < n; ++i) {
            for (std::size_t d = 0; d < command.dims; ++d) point[d] = values[d * batch + i];
            row(point);
        }
    }
}

std::string line(std::span<const float> point, char separator) {
    std::string text;
    for (const float u : point) text += fmt::format("{}{:.9g}", text.empty() ? "" : std::string(1, separator), u);
    return text + '\n';
}

void write(const std::filesystem::path& file, const std::function<void(std::ofstream&)>& content) {
    write_atomically(file, [&](const std::filesystem::path& temporary) {
        std::ofstream out(temporary, std::ios::binary);
        content(out);
        out.flush();
        if (!out) throw Error("the disk is full or the folder is not writable");
    });
}

}  // namespace

int run_points(const PointsCommand& command, const Registry& registry) {
    if (!command.npy.empty())
        write(command.npy, [&](std::ofstream& out) {
            const std::string header = npy_header({command.n, command.dims});
            out.write(header.data(), static_cast<std::streamsize>(header.size()));
            draw(command, registry, [&](std::span<const float> p) { out.write(reinterpret_cast<const char*>(p.data()), static_cast<std::streamsize>(p.size_bytes())); });
        });
    else if (!command.csv.empty())
        write(command.csv, [&](std::ofstream& out) { draw(command, registry, [&](std::span<const float> p) { out << line(p, ','); }); });
    else
        draw(command, registry, [](std::span<const float> p) { fmt::print("{}", line(p, ' ')); });
    return 0;
}

}  // namespace koksma
