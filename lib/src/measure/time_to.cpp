#include <koksma/measure/time_to.h>
#include <koksma/sampling/error.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <string>
#include <vector>

namespace koksma {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

struct Crossing {
    TimeTo::How how = TimeTo::How::not_reached;
    double seconds = kNaN;
};

/// The last crossing of a curve of positive errors, in order of seconds.
Crossing last_crossing(std::span<const double> seconds, std::span<const double> errors, double target) {
    std::size_t first = errors.size();  // the first point from which on all are at or below the target
    while (first > 0 && errors[first - 1] <= target) --first;
    if (first == errors.size()) return {};
    if (first == 0) return {TimeTo::How::measured, seconds[0]};
    const double above = std::log(errors[first - 1] / target);
    const double below = errors[first] > 0 ? std::log(target / errors[first]) : std::numeric_limits<double>::infinity();
    // above > 0. An end of an interval may be infinite: then nothing is known before the next point.
    const double part = std::isinf(above) ? 1 : above / (above + below);
    return {TimeTo::How::interpolated, seconds[first - 1] * std::pow(seconds[first] / seconds[first - 1], part)};
}

}  // namespace

const char* name(TimeTo::How how) noexcept {
    switch (how) {
        case TimeTo::How::measured: return "measured";
        case TimeTo::How::interpolated: return "interpolated";
        case TimeTo::How::not_reached: break;
    }
    return "not_reached";
}

TimeTo time_to(std::span<const TimedError> curve, double target) {
    if (!(std::isfinite(target) && target > 0)) throw Error("time to an error: found " + std::to_string(target) + ", expected > 0");
    std::vector<TimedError> points;
    for (const TimedError& p : curve) {
        if (!(std::isfinite(p.seconds) && p.seconds > 0))
            throw Error("time to an error: found a point at " + std::to_string(p.seconds) + " s, expected > 0");
        if (std::isfinite(p.error.value) && p.error.value > 0) points.push_back(p);
    }
    std::stable_sort(points.begin(), points.end(), [](const TimedError& a, const TimedError& b) { return a.seconds < b.seconds; });

    TimeTo r{TimeTo::How::not_reached, kNaN, kNaN, kNaN, kNaN};
    std::vector<double> seconds, values, lower, upper;
    bool intervals = true;
    for (const TimedError& p : points) {
        seconds.push_back(p.seconds);
        values.push_back(p.error.value);
        lower.push_back(p.error.lo);
        upper.push_back(p.error.hi);
        intervals = intervals && p.error.lo >= 0 && p.error.has_interval();
        r.best_error = std::fmin(r.best_error, p.error.value);
    }
    const Crossing value = last_crossing(seconds, values, target);
    r.how = value.how;
    r.seconds = value.seconds;
    if (!intervals) return r;
    // A lower end that is below the target from the start says nothing of how early it got there.
    if (const Crossing c = last_crossing(seconds, lower, target); c.how == TimeTo::How::interpolated) r.lo = c.seconds;
    r.hi = last_crossing(seconds, upper, target).seconds;
    return r;
}

}  // namespace koksma
