#pragma once
// What a kernel does for a thread: samples in, radiance out.

#include <koksma/plan/plan.h>
#include <koksma/sampling/sample_source.h>

#include <cstdint>
#include <span>

namespace koksma {

/// Rays that a kernel traced.
struct RayCounts {
    std::uint64_t closest = 0, shadow = 0;
};

/// What a tracer has done so far.
struct TraceStats {
    RayCounts rays;
    std::uint64_t tail_numbers = 0;   ///< drawn beyond the layout
    double sampler_seconds = 0.0;     ///< CPU time in the sampler over the timed paths
    std::uint64_t timed_paths = 0;    ///< paths whose fills were timed
    double idle_seconds = 0.0;        ///< spent on measuring: not rendering
};

/// What all tracers of a render share.
struct TraceJob {
    const Scene& scene;
    const RenderPlan& plan;
    const SampleSource& source;
};

/// Hash of what a path met, for comparing kernels: start from 0, one call a ray in the order of the path.
/// @param what  primitive and geometry of a hit (all ones: none), or whether a shadow ray got through
[[nodiscard]] constexpr std::uint64_t path_hash(std::uint64_t hash, std::uint64_t what) noexcept {
    hash = (hash ^ what) * 0x9e3779b97f4a7c15ull;
    return hash ^ (hash >> 29);
}

/// A kernel with its working memory. One per thread.
class Tracer {
public:
    virtual ~Tracer() = default;
    /// @param ids       at most Kernel::batch samples
    /// @param radiance  one value per sample: linear RGB, W sr^-1 m^-2; NaN where a ray could not be traced
    /// @param hashes    one path_hash() per sample, or empty
    virtual void trace(std::span<const SampleId> ids, std::span<Vec3f> radiance, std::span<std::uint64_t> hashes = {}) noexcept = 0;
    [[nodiscard]] const TraceStats& stats() const noexcept { return stats_; }

protected:
    TraceStats stats_;
};

}  // namespace koksma
