#include <koksma/integrators/float_mode.h>
#include <koksma/integrators/render.h>
#include <koksma/integrators/thread_clock.h>
#include <koksma/sampling/error.h>

#include "parallel_tasks.h"

#include <tbb/enumerable_thread_specific.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <memory>
#include <mutex>

namespace koksma {

namespace {

bool earlier(const InvalidSample& a, const InvalidSample& b) noexcept {
    if (a.id.pixel.y != b.id.pixel.y) return a.id.pixel.y < b.id.pixel.y;
    if (a.id.pixel.x != b.id.pixel.x) return a.id.pixel.x < b.id.pixel.x;
    return a.id.index < b.id.index;
}

void add_invalid(RenderStats& stats, const InvalidSample& sample) {
    ++stats.invalid_samples;
    stats.invalid.push_back(sample);
    if (stats.invalid.size() > 2 * RenderStats::kMaxLocated) {
        std::sort(stats.invalid.begin(), stats.invalid.end(), earlier);
        stats.invalid.resize(RenderStats::kMaxLocated);
    }
}

/// Up to a kernel's batch of samples, in pieces that the film takes: samples of one pixel and one chunk. One a thread.
class Batch {
public:
    Batch(const Kernel& kernel, const TraceJob& job) : most_(kernel.batch), tracer_(kernel.make(job)) {
        ids_.reserve(most_);
        radiance_.resize(most_);
    }
    [[nodiscard]] const TraceStats& stats() const { return tracer_->stats(); }
    void add(Pixel pixel, std::uint64_t first, std::size_t count, Film& film, RenderStats& stats) {
        if (ids_.size() + count > most_) flush(film, stats);
        for (std::size_t i = 0; i < count; ++i) ids_.push_back({pixel, first + i});
        pieces_.push_back(count);
    }
    void flush(Film& film, RenderStats& stats) {
        if (ids_.empty()) return;
        tracer_->trace(ids_, std::span(radiance_).first(ids_.size()));
        std::size_t at = 0;
        for (const std::size_t count : pieces_) {
            const std::span<Vec3f> piece(&radiance_[at], count);
            for (std::size_t i = 0; i < count; ++i)
                if (InvalidSample invalid{InvalidSample::Kind::nan, ids_[at + i]}; is_invalid(piece[i], invalid.kind)) {
                    add_invalid(stats, invalid);
                    piece[i] = Vec3f(0.0f);
                }
            film.add(ids_[at].pixel, piece);
            at += count;
        }
        stats.paths += ids_.size();
        ids_.clear();
        pieces_.clear();
    }

private:
    std::size_t most_;
    std::unique_ptr<Tracer> tracer_;
    std::vector<SampleId> ids_;
    std::vector<Vec3f> radiance_;
    std::vector<std::size_t> pieces_;
};

/// All samples of a tile: chunk after chunk (aligned to multiples of Film::kChunk), for every pixel in turn.
RenderStats render_tile(const WorkItem& work, PixelRect tile, Batch& batch, Film& film) {
    const FlushDenormals flush;
    const double start = thread_seconds(), idle = batch.stats().idle_seconds;
    RenderStats stats;
    const std::uint64_t end = work.first + work.count;
    for (std::uint64_t at = work.first; at < end;) {
        const std::uint64_t chunk_end = std::min(end, (at / Film::kChunk + 1) * Film::kChunk);
        for (std::int32_t y = tile.y; y < tile.y + tile.height; ++y)
            for (std::int32_t x = tile.x; x < tile.x + tile.width; ++x) batch.add({x, y}, at, static_cast<std::size_t>(chunk_end - at), film, stats);
        at = chunk_end;
    }
    batch.flush(film, stats);
    stats.cpu_seconds = thread_seconds() - start - (batch.stats().idle_seconds - idle);
    return stats;
}

/// Side of a tile: enough pixels for the kernel's batch.
std::int32_t tile_side(const Kernel& kernel, std::uint64_t count) {
    std::int32_t side = 8;
    while (side < 64 && static_cast<std::uint64_t>(side) * side * std::min<std::uint64_t>(count, Film::kChunk) < kernel.batch) side *= 2;
    return side;
}

void merge(RenderStats& into, const RenderStats& from) {
    into.cpu_seconds += from.cpu_seconds;
    into.paths += from.paths;
    into.invalid_samples += from.invalid_samples;
    into.invalid.insert(into.invalid.end(), from.invalid.begin(), from.invalid.end());
}

void merge(TraceStats& into, const TraceStats& from) {
    into.rays.closest += from.rays.closest;
    into.rays.shadow += from.rays.shadow;
    into.tail_numbers += from.tail_numbers;
    into.sampler_seconds += from.sampler_seconds;
    into.timed_paths += from.timed_paths;
}

}  // namespace

SamplingPlan sampling_plan(const Scene& scene, const RenderPlan& plan, std::uint64_t spp, std::uint64_t seed) {
    return {scene.film.width, scene.film.height, spp, seed, plan.layout};
}

RenderResult render(const Scene& scene, const RenderPlan& plan, const SampleSource& source, const WorkItem& work, const RenderOptions& options) {
    const Kernel& kernel = options.kernel != nullptr ? *options.kernel : choose_kernel(plan.effects);
    if (!kernel.effects.contains(plan.effects)) throw Error("kernel '" + std::string(kernel.name) + "' lacks an effect of the scene");
    RenderResult result{Film(work.rect, !plan.integrator.moments.empty()), {}};
    const std::int32_t side = tile_side(kernel, work.count);
    const std::int32_t columns = (work.rect.width + side - 1) / side, rows = (work.rect.height + side - 1) / side;
    std::vector<RenderStats> tiles(static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows));

    const TraceJob trace_job{scene, plan, source};
    tbb::enumerable_thread_specific<Batch> batches([&] { return Batch(kernel, trace_job); });

    std::mutex progress_mutex;
    std::size_t done = 0;
    const auto start = std::chrono::steady_clock::now();
    const auto run_tile = [&](std::size_t i) {
        if (options.stop.stop_requested()) return;
        const auto column = static_cast<std::int32_t>(i % static_cast<std::size_t>(columns)), row = static_cast<std::int32_t>(i / static_cast<std::size_t>(columns));
        const PixelRect tile{work.rect.x + column * side, work.rect.y + row * side, std::min(side, work.rect.width - column * side),
                             std::min(side, work.rect.height - row * side)};
        tiles[i] = render_tile(work, tile, batches.local(), result.film);
        if (options.progress) {
            const std::lock_guard lock(progress_mutex);
            options.progress(static_cast<double>(++done) / static_cast<double>(tiles.size()));
        }
    };
    detail::for_each_task(tiles.size(), options.threads, run_tile);
    result.stats.wall_seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    for (const RenderStats& t : tiles) merge(result.stats, t);
    TraceStats traced;
    for (const Batch& b : batches) merge(traced, b.stats());
    result.stats.rays = traced.rays;
    result.stats.tail_numbers = traced.tail_numbers;
    if (traced.timed_paths > 0)
        result.stats.sampler_seconds = traced.sampler_seconds * static_cast<double>(result.stats.paths) / static_cast<double>(traced.timed_paths);
    std::sort(result.stats.invalid.begin(), result.stats.invalid.end(), earlier);
    if (result.stats.invalid.size() > RenderStats::kMaxLocated) result.stats.invalid.resize(RenderStats::kMaxLocated);
    result.stats.kernel = kernel.name;
    result.stats.stopped = options.stop.stop_requested();
    return result;
}

}  // namespace koksma
