#include "commands.h"
#include "machine.h"
#include "progress.h"
#include "scene_setup.h"

#include <koksma/film/atomic_file.h>
#include <koksma/film/exr.h>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <cstdio>
#include <fstream>

namespace koksma {

namespace {

const char* technique_name(Technique t) { return t == Technique::light ? "light" : t == Technique::bsdf ? "bsdf" : "mis"; }

nlohmann::ordered_json stats_json(const SceneSetup& setup, const RenderResult& result) {
    const RenderStats& s = result.stats;
    const Vec3d mean = result.film.mean();
    nlohmann::ordered_json invalid = nlohmann::ordered_json::array();
    for (const InvalidSample& i : s.invalid) invalid.push_back({{"kind", name(i.kind)}, {"pixel", {i.id.pixel.x, i.id.pixel.y}}, {"sample", i.id.index}});
    return {{"scene", setup.scene.description.file},
            {"scene_hash", fmt::format("{:016x}", setup.scene.description.hash)},
            {"sampler", setup.sampler->name()},
            {"sampler_version", setup.sampler->info().version},
            {"spp", setup.spp},
            {"seed", setup.seed},
            {"film", {setup.scene.film.width, setup.scene.film.height}},
            {"crop", {setup.rect().x, setup.rect().y, setup.rect().width, setup.rect().height}},
            {"max_depth", setup.plan.integrator.max_depth},
            {"rr_depth", setup.plan.integrator.rr_depth},
            {"technique", technique_name(setup.plan.integrator.technique)},
            {"effects", setup.plan.effects.names()},
            {"dimensions", setup.plan.layout.dimensions()},
            {"kernel", s.kernel},
            {"wall_seconds", s.wall_seconds},
            {"cpu_seconds", s.cpu_seconds},
            {"sampler_seconds", s.sampler_seconds},
            {"paths", s.paths},
            {"rays", s.rays.closest + s.rays.shadow},
            {"rays_closest", s.rays.closest},
            {"rays_shadow", s.rays.shadow},
            {"tail_numbers", s.tail_numbers},
            {"invalid_samples", s.invalid_samples},
            {"invalid", invalid},
            {"mean_rgb", {mean.x, mean.y, mean.z}},
            {"commit", commit()},
            {"embree", Accelerator::version()}};
}

/// The channels of Mitsuba's integrator of that name: X, Y, Z of the image, and of the samples' squares.
void add_moments(ExrImage& exr, const Film& film, const std::string& name) {
    const PixelRect rect = film.rect();
    const char* axes[3] = {".X", ".Y", ".Z"};
    std::vector<float>* planes[6];
    for (std::size_t c = 0; c < 3; ++c) {
        planes[c] = &exr.channels[name + axes[c]];
        planes[3 + c] = &exr.channels["m2_" + name + axes[c]];
    }
    for (std::int32_t y = rect.y; y < rect.y + rect.height; ++y)
        for (std::int32_t x = rect.x; x < rect.x + rect.width; ++x) {
            const Vec3d first = xyz_of(film.mean({x, y})), second = film.second_moment({x, y});
            const double values[6] = {first.x, first.y, first.z, second.x, second.y, second.z};
            for (std::size_t c = 0; c < 6; ++c) planes[c]->push_back(static_cast<float>(values[c]));
        }
}

ExrImage image_of(const RenderCommand& command, const SceneSetup& setup, const RenderResult& result) {
    ExrImage exr;
    const PixelRect rect = setup.rect();
    exr.width = rect.width;
    exr.height = rect.height;
    exr.data_x = rect.x;
    exr.data_y = rect.y;
    exr.display_width = setup.scene.film.width;
    exr.display_height = setup.scene.film.height;
    exr.set_rgb(result.film.image());
    if (result.film.has_moments()) add_moments(exr, result.film, setup.plan.integrator.moments);
    std::string defines;
    for (const std::string& d : command.scene.defines) defines += (defines.empty() ? "" : "\n") + d;
    exr.attributes = {{"koksma:version", version()},
                      {"koksma:commit", commit()},
                      {"koksma:scene", setup.scene.description.file},
                      {"koksma:scene_hash", fmt::format("{:016x}", setup.scene.description.hash)},
                      {"koksma:defines", defines},
                      {"koksma:sampler", setup.sampler->name()},
                      {"koksma:sampler_version", std::to_string(setup.sampler->info().version)},
                      {"koksma:spp", std::to_string(setup.spp)},
                      {"koksma:seed", std::to_string(setup.seed)},
                      {"koksma:max_depth", std::to_string(setup.plan.integrator.max_depth)},
                      {"koksma:rr_depth", std::to_string(setup.plan.integrator.rr_depth)},
                      {"koksma:technique", technique_name(setup.plan.integrator.technique)},
                      {"koksma:invalid_samples", std::to_string(result.stats.invalid_samples)}};
    return exr;
}

void tell_invalid(const RenderCommand& command, const SceneSetup& setup, const RenderStats& stats) {
    const InvalidSample& first = stats.invalid.front();
    fmt::print(stderr, "koksma: {} of {} samples are invalid (they count as zero); the first is {} at pixel {},{} sample {}; to see it:\n", stats.invalid_samples,
               stats.paths, name(first.kind), first.id.pixel.x, first.id.pixel.y, first.id.index);
    fmt::print(stderr, "  koksma replay {} --from {} --pixel {},{} --sample {}\n", setup.scene.description.file, command.output.string(), first.id.pixel.x,
               first.id.pixel.y, first.id.index);
}

}  // namespace

int run_render(const RenderCommand& command, const Registry& registry) {
    if (command.output.extension() != ".exr")
        throw UsageError(fmt::format("--output '{}': images are OpenEXR; give a name that ends in .exr", command.output.string()));
    if (command.stats == command.output) throw UsageError("--stats and --output name the same file");
    require_writable(command.output);
    if (!command.stats.empty()) require_writable(command.stats);
    const SceneSetup setup = set_up(command.scene, registry);
    const GoodCounts& good = setup.sampler->info().good_counts;
    if (!command.quiet && !good.contains(setup.spp))
        fmt::print(stderr, "koksma: note: {} keeps its promise at {}; {} samples per pixel are not\n", setup.sampler->name(), good.text(), setup.spp);
    const std::unique_ptr<SampleSource> source = setup.bind();

    RenderOptions options;
    options.threads = command.threads;
    if (!command.kernel.empty()) {
        try {
            options.kernel = &find_kernel(command.kernel, setup.plan.effects);
        } catch (const Error& e) {
            throw UsageError(e.what());
        }
    }
    RenderResult result;
    {
        Progress progress("render", !command.quiet);
        options.progress = [&](double f) { progress.update(f); };
        result = render(setup.scene, setup.plan, *source, {setup.rect(), 0, setup.spp}, options);
    }
    if (command.strict && result.stats.invalid_samples > 0) {
        tell_invalid(command, setup, result.stats);
        throw Error("invalid samples under --strict; nothing was written");
    }
    write_exr(command.output, image_of(command, setup, result));
    if (!command.stats.empty()) {
        write_atomically(command.stats, [&](const std::filesystem::path& file) {
            std::ofstream out(file);
            out << stats_json(setup, result).dump(2) << '\n';
            out.flush();
            if (!out) throw Error("the disk is full or the folder is not writable");
        });
    }
    if (result.stats.invalid_samples > 0) tell_invalid(command, setup, result.stats);
    return 0;
}

}  // namespace koksma
