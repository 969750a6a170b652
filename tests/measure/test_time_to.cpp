#include <koksma/measure/time_to.h>
#include <koksma/sampling/error.h>
#include <koksma_catch.h>

#include <cmath>
#include <initializer_list>
#include <limits>
#include <string>
#include <vector>

using namespace koksma;

namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

/// Points with an interval from half to twice the value.
std::vector<TimedError> curve(std::initializer_list<std::pair<double, double>> points) {
    std::vector<TimedError> r;
    for (const auto& [seconds, error] : points) r.push_back({seconds, {error, error / 2, error * 2, 0, 4}});
    return r;
}

}  // namespace

TEST_CASE("a time between two points is interpolated on logarithmic scales", "[unit][measure]") {
    // error = 1 / seconds exactly, so the interpolation is exact
    const TimeTo t = time_to(curve({{1, 1}, {2, 0.5}, {4, 0.25}, {8, 0.125}, {16, 0.0625}}), 0.3);
    CHECK(t.how == TimeTo::How::interpolated);
    CHECK(t.seconds == Approx(1 / 0.3));
    CHECK(t.lo == Approx(0.5 / 0.3));
    CHECK(t.hi == Approx(2 / 0.3));
    CHECK(t.best_error == 0.0625);
    CHECK(std::string(name(t.how)) == "interpolated");
}

TEST_CASE("a target that is met at a point takes the seconds of that point", "[unit][measure]") {
    const TimeTo t = time_to(curve({{1, 1}, {2, 0.5}, {4, 0.25}}), 0.5);
    CHECK(t.how == TimeTo::How::interpolated);
    CHECK(t.seconds == Approx(2));
}

TEST_CASE("a curve that starts below the target is measured: at most its first time", "[unit][measure]") {
    const TimeTo t = time_to(curve({{1, 0.1}, {2, 0.05}}), 0.5);
    CHECK(t.how == TimeTo::How::measured);
    CHECK(t.seconds == 1);
    CHECK(std::isnan(t.lo));
    CHECK(t.hi == 1);
    // its upper end is not below: later, perhaps
    CHECK(time_to(curve({{1, 0.4}, {2, 0.1}}), 0.5).hi == Approx(std::pow(2.0, std::log(0.8 / 0.5) / std::log(4.0))));
}

TEST_CASE("a target below every point is not reached and nothing is extrapolated", "[unit][measure]") {
    const TimeTo t = time_to(curve({{1, 1}, {2, 0.5}, {4, 0.25}}), 0.2);
    CHECK(t.how == TimeTo::How::not_reached);
    CHECK(std::isnan(t.seconds));
    CHECK(t.lo == Approx(0.5 / 0.2));  // the lower ends do reach it
    CHECK(std::isnan(t.hi));
    CHECK(t.best_error == 0.25);
    CHECK(std::isnan(time_to(curve({{1, 1}, {2, 0.5}}), 0.2).lo));
    CHECK(std::isnan(time_to({}, 0.2).best_error));
    CHECK(time_to({}, 0.2).how == TimeTo::How::not_reached);
}

TEST_CASE("a curve that crosses several times counts from the last", "[unit][measure]") {
    const TimeTo t = time_to(curve({{1, 1}, {2, 0.25}, {4, 0.6}, {8, 0.15}, {16, 0.1}}), 0.3);
    CHECK(t.how == TimeTo::How::interpolated);
    CHECK(t.seconds == Approx(4 * std::pow(2.0, std::log(2.0) / std::log(4.0))));
    // one that ends above has not reached it
    const TimeTo up = time_to(curve({{1, 1}, {2, 0.25}, {4, 0.6}}), 0.3);
    CHECK(up.how == TimeTo::How::not_reached);
    CHECK(up.best_error == 0.25);
}

TEST_CASE("the order of points and points below the floor do not matter", "[unit][measure]") {
    auto points = curve({{8, 0.125}, {1, 1}, {4, 0.25}, {2, 0.5}});
    points.push_back({16, {kNaN, kNaN, kNaN, kNaN, 4}});
    points.push_back({32, {-1e-3, -2e-3, 1e-3, 0, 4}});
    const TimeTo t = time_to(points, 0.3);
    CHECK(t.seconds == Approx(1 / 0.3));
    CHECK(t.hi == Approx(2 / 0.3));
    CHECK(time_to(points, 0.01).how == TimeTo::How::not_reached);  // below the floor is not "reached"
    CHECK(t.best_error == 0.125);
}

TEST_CASE("points without an interval give a time without one", "[unit][measure]") {
    auto points = curve({{1, 1}, {2, 0.5}, {4, 0.25}});
    points[2].error.lo = points[2].error.hi = kNaN;
    const TimeTo t = time_to(points, 0.3);
    CHECK(t.seconds == Approx(1 / 0.3));
    CHECK(std::isnan(t.lo));
    CHECK(std::isnan(t.hi));
}

TEST_CASE("interval ends of zero and infinity are ends", "[unit][measure]") {
    auto points = curve({{1, 1}, {2, 0.5}, {4, 0.1}});
    points[0].error.hi = std::numeric_limits<double>::infinity();
    points[1].error.hi = std::numeric_limits<double>::infinity();
    points[2].error.lo = 0;
    const TimeTo t = time_to(points, 0.2);
    CHECK(t.hi == Approx(4));
    CHECK(t.lo == Approx(2));
}

TEST_CASE("an impossible target or time is an error", "[unit][measure]") {
    CHECK_THROWS_AS(time_to({}, 0), Error);
    CHECK_THROWS_AS(time_to({}, kNaN), Error);
    CHECK_THROWS_AS(time_to(curve({{0, 1}}), 0.1), Error);
    CHECK_THROWS_AS(time_to(curve({{kNaN, 1}}), 0.1), Error);
}
