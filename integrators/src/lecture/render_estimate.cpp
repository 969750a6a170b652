#include <koksma/integrators/float_mode.h>
#include <koksma/integrators/lecture/render_estimate.h>
#include <koksma/integrators/thread_clock.h>
#include <koksma/sampling/error.h>

#include "../parallel_tasks.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <string>

namespace koksma {

namespace {

constexpr std::int32_t kSide = 8;  // pixels, of a tile

/// All samples of one pixel, chunk by chunk.
void render_pixel(RecursiveEstimator& estimator, Pixel pixel, const WorkItem& work, EstimateResult& result) {
    std::array<Vec3f, Film::kChunk> radiance;
    std::array<std::array<Vec3f, Film::kChunk>, NeumannSeries::kTerms> terms;
    const std::uint64_t end = work.first + work.count;
    for (std::uint64_t at = work.first; at < end;) {
        const std::uint64_t chunk_end = std::min(end, (at / Film::kChunk + 1) * Film::kChunk);
        const auto count = static_cast<std::size_t>(chunk_end - at);
        for (std::size_t i = 0; i < count; ++i) {
            NeumannSeries light = estimator.sample({pixel, at + i});
            if (InvalidSample invalid{InvalidSample::Kind::nan, {pixel, at + i}}; is_invalid(light.total(), invalid.kind)) {
                Ledger& ledger = estimator.ledger();
                ++ledger.invalid_samples;
                if (ledger.invalid.size() < Ledger::kMaxLocated) ledger.invalid.push_back(invalid);
                light = {};
            }
            radiance[i] = light.total();
            for (std::size_t k = 0; k < terms.size(); ++k) terms[k][i] = light.term[k];
        }
        result.film.add(pixel, std::span(radiance).first(count));
        for (std::size_t k = 0; k < result.terms.size(); ++k) result.terms[k].add(pixel, std::span(terms[k]).first(count));
        at = chunk_end;
    }
}

void require_indices(const RenderPlan& plan, const WorkItem& work, const EstimatorSettings& settings) {
    constexpr double kMost = 4294967296.0;
    double indices = static_cast<double>(work.first + work.count);
    for (std::int32_t b = 0; settings.branching > 1 && b + 1 < plan.integrator.max_depth; ++b) indices *= settings.branching;
    if (settings.branching > 1 && indices > kMost)
        throw Error("branching " + std::to_string(settings.branching) + " with max_depth " + std::to_string(plan.integrator.max_depth) +
                    " and " + std::to_string(work.count) + " samples would need more than 2^32 samples of the sequence; lower one of them");
}

}  // namespace

EstimateResult render_estimate(const Scene& scene, const RenderPlan& plan, const SampleSource& source, const WorkItem& work,
                               const EstimatorSettings& settings, bool terms, int threads) {
    require_indices(plan, work, settings);
    EstimateResult result{Film(work.rect), std::vector<Film>(terms ? NeumannSeries::kTerms : 0, Film(work.rect)), {}, 0.0, 0.0};
    const std::int32_t columns = (work.rect.width + kSide - 1) / kSide, rows = (work.rect.height + kSide - 1) / kSide;
    std::vector<Ledger> ledgers(static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows));
    std::vector<double> seconds(ledgers.size());
    const auto start = std::chrono::steady_clock::now();
    const auto run_tile = [&](std::size_t i) {
        const FlushDenormals flush;
        const double thread_start = thread_seconds();
        const auto column = static_cast<std::int32_t>(i % static_cast<std::size_t>(columns)),
                   row = static_cast<std::int32_t>(i / static_cast<std::size_t>(columns));
        RecursiveEstimator estimator(scene, plan, source, settings);
        for (std::int32_t y = row * kSide; y < std::min((row + 1) * kSide, work.rect.height); ++y)
            for (std::int32_t x = column * kSide; x < std::min((column + 1) * kSide, work.rect.width); ++x)
                render_pixel(estimator, {work.rect.x + x, work.rect.y + y}, work, result);
        ledgers[i] = std::move(estimator.ledger());
        seconds[i] = thread_seconds() - thread_start;
    };
    detail::for_each_task(ledgers.size(), threads, run_tile);
    result.wall_seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    for (std::size_t i = 0; i < ledgers.size(); ++i) {  // in the order of tiles: the same sums for any number of threads
        result.ledger.merge(ledgers[i]);
        result.cpu_seconds += seconds[i];
    }
    return result;
}

}  // namespace koksma
