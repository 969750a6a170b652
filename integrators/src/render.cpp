#include <koksma/integrators/render.h>
#include <koksma/integrators/thread_clock.h>
#include <koksma/sampling/error.h>

#include "float_mode.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <mutex>

namespace koksma {

namespace {

constexpr std::int32_t kTile = 8;           // pixels per side of a task
constexpr std::uint64_t kTimedEvery = 16;   // blocks: the fills of one in so many are done again and timed

bool earlier(const InvalidSample& a, const InvalidSample& b) noexcept {
    if (a.id.pixel.y != b.id.pixel.y) return a.id.pixel.y < b.id.pixel.y;
    if (a.id.pixel.x != b.id.pixel.x) return a.id.pixel.x < b.id.pixel.x;
    return a.id.index < b.id.index;
}

/// What the tiles of one render share.
struct Job {
    const Scene& scene;
    const RenderPlan& plan;
    const SampleSource& source;
    const WorkItem& work;
    const Kernel& kernel;
    Film& film;
};

/// Time of the fills of some blocks, done a second time.
struct SamplerClock {
    std::uint64_t phase = 0;  ///< counts blocks; starts elsewhere in each tile
    std::uint64_t paths = 0;
    double seconds = 0.0;
};

void add_invalid(RenderStats& stats, const InvalidSample& sample) {
    ++stats.invalid_samples;
    stats.invalid.push_back(sample);
    if (stats.invalid.size() > 2 * RenderStats::kMaxLocated) {
        std::sort(stats.invalid.begin(), stats.invalid.end(), earlier);
        stats.invalid.resize(RenderStats::kMaxLocated);
    }
}

/// All samples of one pixel, in chunks aligned to multiples of Film::kChunk.
void render_pixel(const Job& job, Pixel pixel, Draws& draws, SamplerClock& clock, RenderStats& stats) {
    SampleId ids[Film::kChunk];
    Vec3f radiance[Film::kChunk];
    const std::uint64_t end = job.work.first + job.work.count;
    for (std::uint64_t at = job.work.first; at < end;) {
        const std::uint64_t chunk_end = std::min(end, (at / Film::kChunk + 1) * Film::kChunk);
        const auto n = static_cast<std::size_t>(chunk_end - at);
        for (std::size_t i = 0; i < n; ++i) ids[i] = {pixel, at + i};
        const bool timed = clock.phase++ % kTimedEvery == 0;
        draws.begin({ids, n}, timed);
        job.kernel.trace(job.scene, job.plan.integrator, draws, {radiance, n}, stats.rays);
        if (timed) {
            clock.seconds += draws.seconds_of_fills();
            clock.paths += n;
        }
        for (std::size_t i = 0; i < n; ++i)
            if (InvalidSample invalid{InvalidSample::Kind::nan, ids[i]}; is_invalid(radiance[i], invalid.kind)) {
                add_invalid(stats, invalid);
                radiance[i] = Vec3f(0.0f);
            }
        job.film.add(pixel, {radiance, n});
        stats.paths += n;
        at = chunk_end;
    }
}

RenderStats render_tile(const Job& job, PixelRect tile) {
    const detail::FlushDenormals flush;
    const double start = thread_seconds();
    RenderStats stats;
    Draws draws(job.plan, job.source);
    SamplerClock clock{static_cast<std::uint64_t>(tile.x + 3 * tile.y) / kTile, 0, 0.0};
    for (std::int32_t y = tile.y; y < tile.y + tile.height; ++y)
        for (std::int32_t x = tile.x; x < tile.x + tile.width; ++x) render_pixel(job, {x, y}, draws, clock, stats);
    if (clock.paths > 0) stats.sampler_seconds = clock.seconds * static_cast<double>(stats.paths) / static_cast<double>(clock.paths);
    stats.tail_numbers = draws.tail_numbers;
    stats.cpu_seconds = thread_seconds() - start - clock.seconds;  // the second time is not rendering
    return stats;
}

void merge(RenderStats& into, const RenderStats& from) {
    into.cpu_seconds += from.cpu_seconds;
    into.sampler_seconds += from.sampler_seconds;
    into.paths += from.paths;
    into.rays.closest += from.rays.closest;
    into.rays.shadow += from.rays.shadow;
    into.tail_numbers += from.tail_numbers;
    into.invalid_samples += from.invalid_samples;
    into.invalid.insert(into.invalid.end(), from.invalid.begin(), from.invalid.end());
}

}  // namespace

SamplingPlan sampling_plan(const Scene& scene, const RenderPlan& plan, std::uint64_t spp, std::uint64_t seed) {
    return {scene.film.width, scene.film.height, spp, seed, plan.layout};
}

RenderResult render(const Scene& scene, const RenderPlan& plan, const SampleSource& source, const WorkItem& work, const RenderOptions& options) {
    const Kernel& kernel = options.kernel != nullptr ? *options.kernel : choose_kernel(plan.effects);
    if (!kernel.effects.contains(plan.effects)) throw Error("kernel '" + std::string(kernel.name) + "' lacks an effect of the scene");
    RenderResult result{Film(work.rect), {}};
    const Job job{scene, plan, source, work, kernel, result.film};
    const std::int32_t columns = (work.rect.width + kTile - 1) / kTile, rows = (work.rect.height + kTile - 1) / kTile;
    std::vector<RenderStats> tiles(static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows));

    std::mutex progress_mutex;
    std::size_t done = 0;
    const auto start = std::chrono::steady_clock::now();
    const auto run_tile = [&](std::size_t i) {
        if (options.stop.stop_requested()) return;
        const auto column = static_cast<std::int32_t>(i % static_cast<std::size_t>(columns)), row = static_cast<std::int32_t>(i / static_cast<std::size_t>(columns));
        const PixelRect tile{work.rect.x + column * kTile, work.rect.y + row * kTile, std::min(kTile, work.rect.width - column * kTile),
                             std::min(kTile, work.rect.height - row * kTile)};
        tiles[i] = render_tile(job, tile);
        if (options.progress) {
            const std::lock_guard lock(progress_mutex);
            options.progress(static_cast<double>(++done) / static_cast<double>(tiles.size()));
        }
    };
    tbb::task_arena arena(options.threads > 0 ? options.threads : tbb::task_arena::automatic);
    arena.execute([&] {
        tbb::parallel_for(tbb::blocked_range<std::size_t>(0, tiles.size(), 1), [&](const auto& range) {
            for (std::size_t i = range.begin(); i != range.end(); ++i) run_tile(i);
        }, tbb::simple_partitioner());
    });
    result.stats.wall_seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    for (const RenderStats& t : tiles) merge(result.stats, t);
    std::sort(result.stats.invalid.begin(), result.stats.invalid.end(), earlier);
    if (result.stats.invalid.size() > RenderStats::kMaxLocated) result.stats.invalid.resize(RenderStats::kMaxLocated);
    result.stats.kernel = kernel.name;
    result.stats.stopped = options.stop.stop_requested();
    return result;
}

}  // namespace koksma
