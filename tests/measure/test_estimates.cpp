#include <koksma/measure/ratio.h>
#include <koksma/measure/rmse_estimate.h>
#include <koksma/sampling/error.h>
#include <koksma_catch.h>

#include <cmath>
#include <vector>

using namespace koksma;

TEST_CASE("a mean of replicates has Student's interval", "[unit][measure]") {
    const double x[] = {1, 2, 3, 4};
    const Estimate e = mean_estimate(x);
    CHECK(e.n == 4);
    CHECK(e.value == 2.5);
    CHECK(e.standard_error == Approx(std::sqrt(5.0 / 3 / 4)));
    CHECK(e.hi - e.value == Approx(3.182446305284263 * e.standard_error));
    CHECK(e.value - e.lo == Approx(e.hi - e.value));
    CHECK(mean_estimate(x, 0.5).hi < e.hi);
}

TEST_CASE("one replicate has a value and no interval", "[unit][measure]") {
    const double one[] = {7.0};
    for (const Estimate& e : {mean_estimate(one), metric_estimate(one), rmse_estimate(one).mse}) {
        CHECK(e.n == 1);
        CHECK(e.value == 7);
        CHECK(std::isnan(e.lo));
        CHECK(std::isnan(e.hi));
        CHECK(std::isnan(e.standard_error));
        CHECK_FALSE(e.has_interval());
    }
    CHECK(std::isnan(mean_estimate({}).value));
    CHECK(std::isnan(metric_estimate({}).value));
    CHECK_FALSE(rmse_estimate({}).below_floor);  // nothing was measured, so nothing was below anything
    CHECK_THROWS_AS(mean_estimate(one, 95), Error);
    CHECK_THROWS_AS(metric_estimate(one, 1), Error);
    CHECK_THROWS_AS(metric_estimate({}, 0), Error);
}

TEST_CASE("an RMSE is the root of the mean of MSEs and its interval the root of theirs", "[unit][measure]") {
    const double mse[] = {0.04, 0.01, 0.03, 0.08};
    const RmseEstimate e = rmse_estimate(mse);
    CHECK(e.mse.value == Approx(0.04));
    CHECK(e.rmse.value == Approx(0.2));
    CHECK(e.rmse.lo == Approx(std::sqrt(e.mse.lo)));
    CHECK(e.rmse.hi == Approx(std::sqrt(e.mse.hi)));
    CHECK(e.rmse.standard_error == Approx(e.mse.standard_error / 0.4));
    CHECK(e.mse.lo > 0);
    CHECK(e.mse.lo == Approx(0.04 * std::exp(-2.353363434801823 * e.mse.standard_error / 0.04)));  // t with 3 degrees at 0.95: all of the 5 % are above
    CHECK(e.mse.hi * e.mse.lo > 0.04 * 0.04);
    CHECK_FALSE(e.below_floor);
}

TEST_CASE("an interval is widened upwards for positive skewness alone", "[unit][measure]") {
    const double left[] = {0.01, 0.05, 0.05, 0.05};
    const Estimate e = metric_estimate(left);
    const double se = e.standard_error / e.value;
    CHECK(e.lo == Approx(e.value * std::exp(-student_t_quantile(0.95, 3) * se)));
    CHECK(e.hi == Approx(e.value * std::exp(student_t_quantile(1 - 0.085 * 0.05, 3) * se)));
    const double right[] = {0.05, 0.01, 0.01, 0.01};
    const Estimate wider = metric_estimate(right);
    CHECK(wider.hi > wider.value * std::exp(student_t_quantile(1 - 0.085 * 0.05, 3) * wider.standard_error / wider.value));
}

TEST_CASE("equal replicates have an interval of no width", "[unit][measure]") {
    const double same[] = {0.25, 0.25, 0.25};
    const RmseEstimate e = rmse_estimate(same);
    CHECK(e.rmse.lo == Approx(0.5));
    CHECK(e.rmse.hi == Approx(0.5));
}

TEST_CASE("a corrected error that is not positive is below the floor", "[unit][measure]") {
    const double negative[] = {-0.02, 0.01, -0.01, 0.005};
    const RmseEstimate e = rmse_estimate(negative);
    CHECK(e.below_floor);
    CHECK(std::isnan(e.mse.value));
    CHECK(std::isnan(e.rmse.value));
    CHECK(std::isnan(e.rmse.hi));
    CHECK(e.mean_mse == Approx(-0.00375));
    CHECK(e.mse.n == 4);
    const double zero[] = {0.0, 0.0};
    CHECK(rmse_estimate(zero).below_floor);
    const double small[] = {0.02, 0.03};
    CHECK_FALSE(rmse_estimate(small).below_floor);
    CHECK(rmse_estimate(small, 0.95, 0.03).below_floor);  // a floor of the caller's
    CHECK(std::isnan(rmse_estimate(small, 0.95, 0.03).rmse.value));
    const double invalid[] = {0.1, std::nan("")};
    CHECK_FALSE(rmse_estimate(invalid).below_floor);
    CHECK(std::isnan(rmse_estimate(invalid).rmse.value));
}

TEST_CASE("a single negative replicate does not spoil a positive mean", "[unit][measure]") {
    const double mse[] = {0.03, -0.01, 0.02, 0.04};
    const RmseEstimate e = rmse_estimate(mse);
    CHECK(e.mse.value == Approx(0.02));
    CHECK(e.mse.interval().contains(0.02));
    CHECK(e.mse.lo > 0);
}

TEST_CASE("a gain is the error of B over that of A", "[unit][measure]") {
    const double a[] = {1.0, 1.1, 0.9, 1.0}, b[] = {2.0, 2.2, 1.8, 2.0};
    const Gain g = gain(a, b);
    CHECK(g.value == Approx(2));
    CHECK(g.distinguishable());
    CHECK(g.lo > 1);
    CHECK(g.dof == Approx(8));  // equal relative variances
    const double se = std::sqrt(2 * (0.02 / 3) / 4);
    CHECK(g.hi == Approx(2 * std::exp(student_t_quantile(1 - 0.41 * 0.05, 8) * se)));  // as much variance on both sides
    const Gain inverse = gain(b, a);
    CHECK(inverse.value == Approx(0.5));
    CHECK(inverse.lo == Approx(1 / g.hi));
    CHECK(inverse.distinguishable());
    CHECK_FALSE(gain(a, a).distinguishable());
}

TEST_CASE("a gain without replicates or above no floor claims nothing", "[unit][measure]") {
    const double one[] = {1.0}, many[] = {3.0, 3.1, 2.9}, negative[] = {-1.0, 0.5};
    const Gain g = gain(one, many);
    CHECK(g.value == Approx(3));
    CHECK(std::isnan(g.lo));
    CHECK_FALSE(g.distinguishable());
    CHECK(gain(negative, many).below_floor);
    CHECK(gain(many, negative).below_floor);
    CHECK(std::isnan(gain(many, negative).value));
    CHECK_FALSE(gain(many, negative).distinguishable());
    CHECK_THROWS_AS(gain(many, negative, 95), Error);
}
