#pragma once
// Rendering: a scene, a plan and a sampler in, a film and its ledger out.

#include <koksma/film/film.h>
#include <koksma/integrators/kernel.h>
#include <koksma/plan/plan.h>
#include <koksma/sampling/sample_source.h>

#include <functional>
#include <stop_token>
#include <vector>

namespace koksma {

/// A piece of work: all of a rectangle's samples with indices [first, first + count).
struct WorkItem {
    PixelRect rect;
    std::uint64_t first = 0, count = 1;
};

struct RenderOptions {
    int threads = 0;                             ///< 0: all that TBB would use
    const Kernel* kernel = nullptr;              ///< nullptr: the smallest admissible one
    std::stop_token stop{};                      ///< asked between tiles
    std::function<void(double)> progress{};      ///< fraction done, from any thread, calls serialised
};

struct RenderStats {
    double wall_seconds = 0.0;        ///< of rendering alone
    double cpu_seconds = 0.0;         ///< sum over threads of their CPU time in rendering
    double sampler_seconds = 0.0;     ///< CPU time in the sampler, estimated from a part of the paths
    std::uint64_t paths = 0;
    RayCounts rays;
    std::uint64_t tail_numbers = 0;   ///< drawn beyond the layout
    std::uint64_t invalid_samples = 0;
    std::vector<InvalidSample> invalid;  ///< the first kMaxLocated by (row, column, sample)
    static constexpr std::size_t kMaxLocated = 64;
    std::string_view kernel;
    bool stopped = false;             ///< the stop token was set: the film is incomplete
};

struct RenderResult {
    Film film;
    RenderStats stats;
};

/// Renders one work item. Same bytes for every number of threads.
/// @param source  bound to a plan with render_plan.layout and the scene's film
[[nodiscard]] RenderResult render(const Scene& scene, const RenderPlan& plan, const SampleSource& source, const WorkItem& work,
                                  const RenderOptions& options = {});

/// The plan that a sampler is bound to for rendering.
[[nodiscard]] SamplingPlan sampling_plan(const Scene& scene, const RenderPlan& plan, std::uint64_t spp, std::uint64_t seed);

/// The rectangle that the scene's film asks for.
[[nodiscard]] constexpr PixelRect crop_of(const FilmSettings& film) noexcept {
    return film.crop_width == 0 ? PixelRect{0, 0, film.width, film.height} : PixelRect{film.crop_x, film.crop_y, film.crop_width, film.crop_height};
}

}  // namespace koksma
