#include <koksma/integrators/float_mode.h>
#include <koksma/integrators/lecture/adaptive.h>
#include <koksma/integrators/thread_clock.h>

#include "../parallel_tasks.h"

#include <tbb/enumerable_thread_specific.h>

#include <algorithm>
#include <chrono>
#include <memory>

namespace koksma {

namespace {

/// Pixels of one row after the other are gathered until a kernel has its batch.
class Gathered {
public:
    Gathered(const Kernel& kernel, Tracer& tracer, Film& film, RenderStats& stats)
        : kernel_(kernel), tracer_(tracer), film_(film), stats_(stats), radiance_(kernel.batch) {}
    void add(Pixel pixel, std::uint64_t count) {
        for (std::uint64_t at = 0; at < count; at += Film::kChunk) {
            const std::uint64_t end = std::min(count, at + Film::kChunk);
            if (ids_.size() + (end - at) > kernel_.batch) flush();
            for (std::uint64_t i = at; i < end; ++i) ids_.push_back({pixel, i});
            pieces_.push_back(static_cast<std::size_t>(end - at));
        }
    }
    void flush() {
        tracer_.trace(ids_, std::span(radiance_).first(ids_.size()));
        std::size_t at = 0;
        for (const std::size_t count : pieces_) {
            for (std::size_t i = at; i < at + count; ++i)
                if (InvalidSample invalid{InvalidSample::Kind::nan, ids_[i]}; is_invalid(radiance_[i], invalid.kind)) {
                    ++stats_.invalid_samples;
                    if (stats_.invalid.size() < RenderStats::kMaxLocated) stats_.invalid.push_back(invalid);
                    radiance_[i] = Vec3f(0.0f);
                }
            film_.add(ids_[at].pixel, std::span(radiance_).subspan(at, count));
            at += count;
        }
        stats_.paths += ids_.size();
        ids_.clear();
        pieces_.clear();
    }

private:
    const Kernel& kernel_;
    Tracer& tracer_;
    Film& film_;
    RenderStats& stats_;
    std::vector<SampleId> ids_;
    std::vector<Vec3f> radiance_;
    std::vector<std::size_t> pieces_;
};

}  // namespace

RenderResult render_counts(const Scene& scene, const RenderPlan& plan, const SampleSource& source, PixelRect rect,
                           const std::vector<std::uint64_t>& counts, int threads) {
    const auto width = static_cast<std::size_t>(rect.width);
    if (counts.size() != static_cast<std::size_t>(rect.area()))
        throw Error("render_counts: there must be one count for each pixel of the rectangle");
    const Kernel& kernel = choose_kernel(plan.effects);
    RenderResult result{Film(rect), {}};
    tbb::enumerable_thread_specific<std::unique_ptr<Tracer>> tracers([&] { return kernel.make({scene, plan, source}); });
    std::vector<RenderStats> rows(static_cast<std::size_t>(rect.height));
    const auto start = std::chrono::steady_clock::now();
    const auto run_row = [&](std::size_t row) {
        const FlushDenormals flush;
        Tracer& tracer = *tracers.local();
        const double thread_start = thread_seconds(), idle = tracer.stats().idle_seconds;
        Gathered gathered(kernel, tracer, result.film, rows[row]);
        for (std::size_t column = 0; column < width; ++column)
            gathered.add({rect.x + static_cast<std::int32_t>(column), rect.y + static_cast<std::int32_t>(row)},
                         counts[row * width + column]);
        gathered.flush();
        rows[row].cpu_seconds = thread_seconds() - thread_start - (tracer.stats().idle_seconds - idle);
    };
    detail::for_each_task(rows.size(), threads, run_row);
    result.stats.wall_seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    for (const RenderStats& row : rows) {
        result.stats.cpu_seconds += row.cpu_seconds;
        result.stats.paths += row.paths;
        result.stats.invalid_samples += row.invalid_samples;
        const std::size_t room = RenderStats::kMaxLocated - result.stats.invalid.size();
        result.stats.invalid.insert(result.stats.invalid.end(), row.invalid.begin(),
                                    row.invalid.begin() + static_cast<std::ptrdiff_t>(std::min(room, row.invalid.size())));
    }
    for (const std::unique_ptr<Tracer>& tracer : tracers) {
        result.stats.rays.closest += tracer->stats().rays.closest;
        result.stats.rays.shadow += tracer->stats().rays.shadow;
        result.stats.tail_numbers += tracer->stats().tail_numbers;
    }
    result.stats.kernel = kernel.name;
    return result;
}

}  // namespace koksma
