#pragma once
// The seconds a sampler takes to reach an error. Never extrapolated.

#include <koksma/measure/statistics.h>

namespace koksma {

/// One measured point of a curve.
struct TimedError {
    double seconds = 0;  ///< rendering time, > 0
    Estimate error;      ///< relMSE (or any error metric) with its interval
};

struct TimeTo {
    enum class How { measured, interpolated, not_reached };
    How how = How::not_reached;  ///< measured: the quickest point is at or below the target already, so "at most" its seconds
    double seconds = 0;          ///< NaN if not reached
    double lo = 0, hi = 0;       ///< from the curves of lower and upper ends; NaN where such a curve does not cross the target
    double best_error = 0;       ///< smallest error among the usable points; NaN if there is none
};
[[nodiscard]] const char* name(TimeTo::How how) noexcept;

/// When the error came below the target to stay.
/// The curve is read in order of seconds. Points whose error is not finite and positive (below the floor) are left out.
/// A curve that crosses the target several times counts from its last crossing: the first measured time after which every
/// measured point is at or below the target. One that ends above the target has not reached it, even if it dipped below:
/// best_error < target shows that. Between the two neighbouring points, log error is linear in log seconds.
/// lo and hi are the same question asked of the curves of interval ends: NaN if that curve is at or below the target from its
/// first point (lo: it may be earlier than anything measured), does not reach it (hi: it may be later), or has a point
/// without an interval. The uncertainty of the seconds themselves is not in them.
/// @param  target  > 0
/// @throws         Error if the target or a time is not finite and > 0
[[nodiscard]] TimeTo time_to(std::span<const TimedError> curve, double target);

}  // namespace koksma
