#include "price.h"

#include "machine.h"
#include "progress.h"
#include "reference_store.h"
#include "row_store.h"

#include <fmt/format.h>

#include <chrono>

namespace koksma {

namespace {

constexpr std::uint64_t kProbe = 16;  // samples a pixel

/// CPU seconds a path of a small render.
double seconds_per_path(const BenchScene& s, const SamplerFactory& sampler, int threads) {
    const auto source = sampler.bind(sampling_plan(s.scene, s.plan, kProbe, 0));
    RenderOptions options;
    options.threads = threads;
    const RenderStats stats = render(s.scene, s.plan, *source, {s.what.crop, 0, kProbe}, options).stats;
    return stats.cpu_seconds / static_cast<double>(stats.paths);
}

/// Seconds that comparing one image takes, FLIP included.
double seconds_per_judgement(const BenchScene& s, const Registry& registry, int threads) {
    const auto source = registry.make("random")->bind(sampling_plan(s.scene, s.plan, kProbe, 0));
    RenderOptions options;
    options.threads = threads;
    const std::vector<float> image = render(s.scene, s.plan, *source, {s.what.crop, 0, kProbe}, options).film.image();
    const auto start = std::chrono::steady_clock::now();
    static_cast<void>(HdrFlip(image, s.what.crop.width, s.what.crop.height).mean(image));
    return 0.5 * std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

}  // namespace

void print_price(const Run& run, const std::vector<PlannedTrial>& trials, const Registry& registry, const std::filesystem::path& folder, bool fresh, int threads) {
    const int cores = threads > 0 ? threads : machine().cores;
    std::size_t kept = 0;  // rows of the folder: their keys need the references, so only their number is told
    if (!fresh && (std::filesystem::exists(folder / "results.jsonl") || std::filesystem::exists(folder / "results.partial.jsonl"))) kept = count_rows(folder);
    double total = 0.0, wall = 0.0;
    fmt::print("{:<12}{:>10}{:>14}{:>12}{:>14}  reference\n", "scene", "renders", "paths", "ns/path", "CPU seconds");
    for (std::size_t i = 0; i < run.scenes.size(); ++i) {
        const BenchScene& s = run.scenes[i];
        const auto area = static_cast<double>(s.what.crop.area());
        std::vector<double> per_path;
        double plain = 0.0, cpu = 0.0, paths = 0.0;
        for (const auto& sampler : run.samplers) per_path.push_back(seconds_per_path(s, *sampler, threads));
        plain = seconds_per_path(s, *registry.make(run.experiment.reference.samplers.front()), threads);
        std::size_t renders = 0, judged = 0;
        for (const PlannedTrial& t : trials) {
            if (t.scene != i) continue;
            ++renders;
            judged += with_flip(t.trial);
            paths += static_cast<double>(t.trial.spp) * area;
            cpu += static_cast<double>(t.trial.spp) * area * per_path[t.sampler];
        }
        const auto file = find_reference(s.key);
        const double reference =
            file ? 0.0 : 2.0 * run.experiment.reference.replicates * static_cast<double>(run.experiment.reference.spp) * area * plain;
        const double size = run.experiment.picture_size;
        const double film = std::max(s.scene.film.width, s.scene.film.height);
        const double picture = static_cast<double>(run.experiment.picture_spp) * size * size * s.scene.film.width * s.scene.film.height / (film * film) * plain;
        const double judging = static_cast<double>(judged) * seconds_per_judgement(s, registry, threads);
        total += cpu + reference + picture + judging;
        wall += (cpu + reference + picture) / cores + judging;
        fmt::print("{:<12}{:>10}{:>14.0f}{:>12.0f}{:>14.1f}  {}\n", s.what.name, renders, paths, paths > 0 ? 1e9 * cpu / paths : 0.0, cpu,
                   file ? file->string() : fmt::format("must be made: {:.1f} CPU seconds", reference));
    }
    fmt::print("about {} of CPU time, {} on {} cores with pictures and FLIP, and some seconds for the report\n", duration_text(total), duration_text(wall), cores);
    if (kept > 0) fmt::print("the folder has {} rows of earlier runs; those that still hold are not rendered again, so it may be less\n", kept);
}

}  // namespace koksma
