#pragma once
// A vectorised fill against the point it stands for. Needs the sampler's type, so it is a template for the sampler's own test.

#include <koksma/sampling/sample_source.h>

#include <algorithm>
#include <string>
#include <vector>

namespace koksma::conformance {

/// Compares T's own `fill` with `point`, bit for bit, for batches of 1 .. 70 samples, all runs of slots, and given pixels.
/// @param tables  as the sampler's constructor takes them, or nothing
/// @return        empty, or where the first difference is
template <BatchSampler T, class... Tables>
[[nodiscard]] std::string difference_of_fill_and_point(const SamplerOptions& options, const SamplingPlan& plan,
                                                       std::span<const SampleId> samples, const Tables&... tables) {
    const LiftedSource<T> source(options, plan, tables...);
    const SlotRun all = plan.layout.slots();
    std::size_t begin = 0;
    for (std::size_t n = 1; begin < samples.size(); begin += n, n = n % 70 + 1) {
        const auto batch = samples.subspan(begin, std::min(n, samples.size() - begin));
        for (std::size_t first = 0; first < all.size(); ++first) {
            const SlotRun run = all.subspan(first);
            const std::size_t stride = batch.size() + n % 3;
            std::vector<float> fast(dimension_count(run) * stride, -1.0f), plain = fast;
            source.fill(batch, run, fast.data(), stride);
            source.fill_scalar(batch, run, plain.data(), stride);
            const auto at = std::mismatch(fast.begin(), fast.end(), plain.begin());
            if (at.first == fast.end()) continue;
            const auto k = static_cast<std::size_t>(at.first - fast.begin());
            return "dimension " + std::to_string(run.front().dimension + k / stride) + ", place " + std::to_string(k % stride) +
                   " of a batch of " + std::to_string(batch.size()) + ": fill gives " + std::to_string(*at.first) + ", point " +
                   std::to_string(*at.second);
        }
    }
    return {};
}

}  // namespace koksma::conformance
