#include "commands.h"
#include "experiment.h"
#include "machine.h"
#include "python.h"
#include "rates_json.h"
#include "sampler_json.h"
#include "scene_setup.h"

#include <koksma/film/atomic_file.h>
#include <koksma/measure/point_set.h>

#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <unistd.h>

#include <array>
#include <chrono>
#include <cmath>
#include <fstream>

namespace koksma {

namespace {

using Json = nlohmann::ordered_json;

constexpr std::uint64_t kSeed = 1;
constexpr std::uint32_t kDimensions = 32;

/// The first `n` points of a plan for n samples, drawn in pairs, in double.
std::vector<double> points_of(const SamplerFactory& factory, std::uint64_t n, std::uint32_t dimensions, std::uint64_t seed) {
    const std::vector<std::uint8_t> arities(dimensions / 2, 2);
    const SamplingPlan plan{.spp = n, .seed = seed, .layout = plain_layout(arities)};
    const auto source = factory.bind(plan);
    std::vector<SampleId> ids(n);
    for (std::size_t i = 0; i < n; ++i) ids[i].index = i;
    std::vector<float> values(n * dimensions);
    source->fill(ids, plan.layout.slots(), values.data(), n);
    std::vector<double> rows(values.size());
    for (std::size_t i = 0; i < n; ++i)
        for (std::size_t d = 0; d < dimensions; ++d) rows[i * dimensions + d] = static_cast<double>(values[d * n + i]);
    return rows;
}

/// Dimensions a..b of rows of `dimensions`.
std::vector<double> leading(const std::vector<double>& rows, std::size_t dimensions, std::size_t wanted) {
    std::vector<double> part;
    for (std::size_t i = 0; i < rows.size(); i += dimensions) part.insert(part.end(), rows.begin() + static_cast<std::ptrdiff_t>(i), rows.begin() + static_cast<std::ptrdiff_t>(i + wanted));
    return part;
}

std::uint64_t good_count_below(const SamplerInfo& info, std::uint64_t most) {
    std::uint64_t n = std::min(most, info.max_samples);
    while (n > 1 && !info.good_counts.contains(n)) --n;
    return n;
}

Json pictures(const SamplerFactory& factory) {
    const std::uint64_t n = good_count_below(factory.info(), 256);
    const std::vector<double> rows = points_of(factory, n, kDimensions, kSeed);
    Json projections = Json::array();
    for (const auto& [a, b] : {std::pair{0u, 1u}, {2u, 3u}, {0u, 2u}, {1u, 3u}, {6u, 7u}, {14u, 15u}, {5u, 8u}, {30u, 31u}}) {
        Json x = Json::array(), y = Json::array();
        for (std::size_t i = 0; i < n; ++i) x.push_back(rows[i * kDimensions + a]), y.push_back(rows[i * kDimensions + b]);
        projections.push_back({{"a", a}, {"b", b}, {"x", x}, {"y", y}});
    }
    return {{"n", n}, {"projections", projections}};
}

/// Mean over seeds of the spectrum of the first pair.
Json spectrum(const SamplerFactory& factory) {
    constexpr int kLargest = 48;
    const int replicates = factory.randomized() ? 16 : 1;
    const std::uint64_t n = good_count_below(factory.info(), 256);
    Spectrum mean{.largest = kLargest};
    for (int r = 0; r < replicates; ++r) {
        const std::vector<double> rows = points_of(factory, n, 2, kSeed + static_cast<std::uint64_t>(r));
        const Spectrum one = power_spectrum({rows, 2}, 0, 1, kLargest);
        mean.power.resize(one.power.size(), 0.0);
        for (std::size_t k = 0; k < one.power.size(); ++k) mean.power[k] += one.power[k] / replicates;
    }
    return {{"n", n}, {"replicates", replicates}, {"largest", kLargest}, {"power", mean.power}, {"radial", radial_mean(mean)}};
}

Json discrepancies(const SamplerFactory& factory) {
    constexpr std::uint64_t kMostExact = 1024;
    constexpr std::size_t kBrackets = 20000;
    Json rows = Json::array();
    for (std::uint64_t k = 2; k <= 2 * kMostExact; k *= 2)
        for (const std::uint64_t n : {k, k + k / 2}) {
            if (n > kMostExact || n > factory.info().max_samples) continue;
            const std::vector<double> all = points_of(factory, n, 4, kSeed), one = leading(all, 4, 1), two = leading(all, 4, 2), three = leading(all, 4, 3);
            const StarBounds star3 = star_discrepancy_bounds({three, 3}, kBrackets), star4 = star_discrepancy_bounds({all, 4}, kBrackets);
            rows.push_back({{"n", n},
                            {"good", factory.info().good_counts.contains(n)},
                            {"star1", star_discrepancy({one, 1})},
                            {"star2", star_discrepancy({two, 2})},
                            {"star3", {{"lo", star3.lower}, {"hi", star3.upper}}},
                            {"star4", {{"lo", star4.lower}, {"hi", star4.upper}}},
                            {"l2star2", l2_star_discrepancy({two, 2})},
                            {"l2star4", l2_star_discrepancy({all, 4})},
                            {"centred2", centred_discrepancy({two, 2})},
                            {"wraparound2", wraparound_discrepancy({two, 2})},
                            {"mixture2", mixture_discrepancy({two, 2})},
                            {"random2", random_l2_star_discrepancy(n, 2)},
                            {"random4", random_l2_star_discrepancy(n, 4)}});
        }
    return rows;
}

/// t of all projections on one to four of the first eight dimensions, at 256 points: the t of each pair, and how many have which.
Json quality(const SamplerFactory& factory) {
    constexpr std::size_t kOf = 8, kPoints = 256;
    if (factory.info().max_samples < kPoints) return nullptr;
    const std::vector<double> rows = points_of(factory, kPoints, kOf, kSeed);
    Json histogram = Json::array(), pairs = Json::array();
    for (std::size_t size = 1; size <= 4; ++size) {
        std::array<int, 9> count{};
        for (unsigned set = 0; set < 1u << kOf; ++set) {
            std::vector<std::size_t> projection;
            for (std::size_t d = 0; d < kOf; ++d)
                if (set >> d & 1u) projection.push_back(d);
            if (projection.size() != size) continue;
            const int t = quality_parameter({rows, kOf}, projection);
            ++count[static_cast<std::size_t>(t)];
            if (size == 2) pairs.push_back({{"a", projection[0]}, {"b", projection[1]}, {"t", t}});
        }
        histogram.push_back({{"dimensions", size}, {"count", count}});
    }
    return {{"n", kPoints}, {"of", kOf}, {"histogram", histogram}, {"pairs", pairs}};
}

/// Nanoseconds a dimension, the fastest of five runs: 4096 samples a call (vectorised where the sampler is), and one sample a call.
Json speed(const SamplerFactory& factory) {
    const std::uint64_t n = good_count_below(factory.info(), 4096);
    const std::vector<std::uint8_t> arities(kDimensions / 2, 2);
    const SamplingPlan plan{.spp = n, .seed = kSeed, .layout = plain_layout(arities)};
    const auto source = factory.bind(plan);
    std::vector<SampleId> ids(n);
    for (std::size_t i = 0; i < n; ++i) ids[i].index = i;
    std::vector<float> values(n * kDimensions);
    const auto measure = [&](std::size_t batch) {
        double best = 1e30;
        for (int run = 0; run < 5; ++run) {
            const auto start = std::chrono::steady_clock::now();
            for (std::size_t i = 0; i < n; i += batch)
                source->fill(std::span(ids).subspan(i, std::min<std::size_t>(batch, n - i)), plan.layout.slots(), values.data() + i, n);
            const std::chrono::duration<double, std::nano> time = std::chrono::steady_clock::now() - start;
            best = std::min(best, time.count() / static_cast<double>(n * kDimensions));
        }
        return best;
    };
    return {{"batch", measure(n)}, {"batch_size", n}, {"single", measure(1)}};
}

Json rates(const SamplerFactory& factory) {
    if (!factory.randomized()) return nullptr;
    Json all = Json::array();
    try {
        for (const convergence::Rates& r : all_rates(factory, {}, 4096, 128)) all.push_back(json_of(r));
    } catch (const UsageError&) {
        return nullptr;  // too few good counts: the card says so
    }
    return all;
}

Json card_of(const SamplerFactory& factory) {
    if (factory.info().max_dimensions < kDimensions)
        throw UsageError(fmt::format("a card draws {} dimensions; sampler '{}' has {}", kDimensions, factory.name(), factory.info().max_dimensions));
    return {{"name", factory.name()},       {"info", json_of(factory.info())},        {"version", version_text()},    {"randomized", factory.randomized()},     {"seed", kSeed},
            {"pictures", pictures(factory)}, {"spectrum", spectrum(factory)},         {"discrepancies", discrepancies(factory)},
            {"quality", quality(factory)},  {"speed", speed(factory)},                {"rates", rates(factory)}};
}

std::string file_name(std::string name) {
    for (char& c : name)
        if (c == ':' || c == ',' || c == '=' || c == '/') c = '-';
    return name + ".html";
}

}  // namespace

int run_card(const CardCommand& command, const Registry& registry) {
    const auto factory = make_sampler(registry, command.sampler);
    const Json card = card_of(*factory);
    if (command.json) {
        fmt::print("{}\n", card.dump(1));
        return 0;
    }
    const std::filesystem::path page = command.output.empty() ? std::filesystem::path(file_name(factory->name())) : command.output;
    // The numbers go to Python in a file beside the page.
    const std::filesystem::path numbers = page.string() + fmt::format(".{}.json", ::getpid());
    write_atomically(numbers, [&](const std::filesystem::path& file) {
        std::ofstream out(file);
        out << card.dump() << '\n';
        out.flush();
        if (!out) throw Error("the disk is full or the folder is not writable");
    });
    const std::string python_path = (data_directory() / "bench").string();
    const int code = run_python({"-m", "report.card", numbers.string(), page.string()}, python_path);
    std::error_code ignored;
    std::filesystem::remove(numbers, ignored);
    if (code == 127) throw Error(fmt::format("{} cannot be started; install python3, python3-numpy, python3-matplotlib and python3-jinja2", python_program()));
    if (code != 0) throw Error(fmt::format("'{} -m report.card' ended with code {} (its message is above)", python_program(), code));
    return 0;
}

}  // namespace koksma
