#pragma once
// Where something that moves is at an instant.

#include <koksma/scene/description.h>

#include <vector>

namespace koksma {

/// The most pieces of straight motion into which the time of a shutter is cut: Embree's limit is one more.
inline constexpr std::size_t kMostMotionSteps = 128;

/// The placement at an instant. Each keyframe is taken apart into a translation, a rotation and a symmetric stretch; translation and
/// stretch are interpolated linearly, the rotation by slerp. That is what Mitsuba 0.6 does with <animation>; Mitsuba 3 has none.
/// @param animation  not empty, in order of time, linear parts invertible
/// Source: Shoemake & Duff 1992, "Matrix animation and polar decomposition"; the iteration by Higham 1986, "Computing the polar
/// decomposition"
[[nodiscard]] glm::dmat4 placement_at(const Animation& animation, double time);

/// Placements at equal distances in time from `open` to `close`, so many that straight lines between them are off by at most 1e-4 of the
/// object's size and of its way, up to kMostMotionSteps pieces. One placement where nothing moves.
[[nodiscard]] std::vector<glm::dmat4> sampled(const Animation& animation, double open, double close);

}  // namespace koksma
