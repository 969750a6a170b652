#include "machine.h"
#include "measure.h"
#include "progress.h"
#include "reference_store.h"

#include <fmt/format.h>

namespace koksma {

namespace {

/// Seconds of CPU time a path, from a small render.
double seconds_per_path(const BenchScene& s, const Registry& registry, int threads) {
    const auto source = registry.make("random")->bind(sampling_plan(s.scene, s.plan, 16, 0));
    RenderOptions options;
    options.threads = threads;
    const RenderStats stats = render(s.scene, s.plan, *source, {s.what.crop, 0, 16}, options).stats;
    return stats.cpu_seconds / static_cast<double>(stats.paths);
}

}  // namespace

Amount amount_of(const Experiment& e, const SamplerFactory& sampler) {
    Amount amount;
    for (const Count& c : counts_of(e, sampler.info())) {
        const auto renders = static_cast<std::uint64_t>(sampler.randomized() ? c.replicates : 1) * static_cast<std::uint64_t>(e.layouts);
        amount.renders += renders;
        amount.paths_per_pixel += renders * c.spp;
    }
    return amount;
}

void print_price(const Experiment& experiment, const std::vector<BenchScene>& scenes, const std::vector<std::unique_ptr<SamplerFactory>>& samplers, const Registry& registry,
                 int threads) {
    const int cores = threads > 0 ? threads : machine().cores;
    double total = 0.0;
    fmt::print("{:<10}{:>12}{:>14}{:>12}{:>14}  reference\n", "scene", "renders", "paths", "ns/path", "CPU seconds");
    Amount all;
    for (const auto& sampler : samplers) {
        const Amount one = amount_of(experiment, *sampler);
        all.renders += one.renders;
        all.paths_per_pixel += one.paths_per_pixel;
    }
    for (const BenchScene& s : scenes) {
        const double per_path = seconds_per_path(s, registry, threads);
        const auto paths = static_cast<double>(all.paths_per_pixel) * static_cast<double>(s.what.crop.area());
        const auto file = find_reference(s.key);
        const double reference = file ? 0.0 : 2.0 * experiment.reference.replicates * static_cast<double>(experiment.reference.spp) * static_cast<double>(s.what.crop.area()) * per_path;
        total += paths * per_path + reference;
        fmt::print("{:<10}{:>12}{:>14.0f}{:>12.0f}{:>14.1f}  {}\n", s.what.name, all.renders, paths, per_path * 1e9, paths * per_path,
                   file ? file->string() : fmt::format("must be made: {:.1f} CPU seconds", reference));
    }
    fmt::print("about {} of CPU time, {} on {} cores, and the pictures and the report\n", duration_text(total), duration_text(total / cores), cores);
}

}  // namespace koksma
