#pragma once
// Working memory of the batch kernel: queues of paths and of shadow rays, one array a number.

#include <koksma/math/vec3.h>
#include <koksma/sampling/bits.h>

#include <cstddef>
#include <cstdint>

namespace koksma::detail {

/// Paths in flight: as many as fit a core's own cache with all that belongs to them.
inline constexpr std::size_t kBatchCapacity = 4096;

/// Length of an array. Compressing stores may write a pack beyond the last entry; and rows that are not a power of two apart
/// do not fall on one another in the cache.
inline constexpr std::size_t kBatchRow = kBatchCapacity + 16;

using FloatRow = float[kBatchRow];
using IntRow = std::int32_t[kBatchRow];

/// A vector a path, or a ray.
template <std::size_t kRow>
struct alignas(64) VectorRowsOf {
    float x[kRow], y[kRow], z[kRow];
};
using VectorRows = VectorRowsOf<kBatchRow>;

/// The paths that are still alive, close together.
struct alignas(64) PathQueue {
    VectorRows o, d;             ///< the next ray
    FloatRow t_near, t_far;      ///< of camera rays; later ones go from 0 to infinity
    FloatRow time;               ///< within the shutter's interval; only where something moves
    VectorRows beta;             ///< f |cos| / pdf of the path so far
    FloatRow eta_scale;          ///< square of the index that the path is in
    VectorRows last_p;           ///< where the last direction was sampled,
    VectorRows last_n;           ///< the shading normal there, for choosing among many lights,
    FloatRow pdf;                ///< with which density per steradian,
    IntRow delta;                ///< and -1 if light sampling could not have made it
    IntRow lossless;             ///< bounces in a row after which nothing was lost
    IntRow slot;                 ///< which sample of the batch
    SampleId id[kBatchRow];      ///< the same, for the sampler
};

/// What the rays of the paths met.
struct alignas(64) Met {
    IntRow geometry, primitive;  ///< geometry -1: nothing
    IntRow instance;             ///< -1: seen without one
};

/// Shadow rays of one bounce, with what they bring if nothing is in the way.
struct alignas(64) ShadowQueue {
    VectorRows o, d;
    FloatRow t_far, time;
    VectorRows contribution;
    IntRow slot;
};

}  // namespace koksma::detail
