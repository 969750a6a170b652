#include <koksma/measure/statistics.h>
#include <koksma/sampling/error.h>
#include <koksma_catch.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

using namespace koksma;

namespace {

/// P(T <= t) for t > 0 by Simpson's rule on the density: another way to the same number.
double integrated_cdf(double t, double dof) {
    const double scale = std::exp(std::lgamma((dof + 1) / 2) - std::lgamma(dof / 2)) / std::sqrt(dof * std::numbers::pi);
    const auto density = [&](double x) { return scale * std::pow(1 + x * x / dof, -(dof + 1) / 2); };
    constexpr int kSteps = 2000;
    const double h = t / kSteps;
    double sum = density(0) + density(t);
    for (int i = 1; i < kSteps; ++i) sum += (i % 2 == 1 ? 4 : 2) * density(i * h);
    return 0.5 + sum * h / 3;
}

}  // namespace

TEST_CASE("quantiles of Student's t agree with the tables", "[unit][measure]") {
    // t_0.975 to more digits than printed tables have; 1, 2 and 4 degrees are closed forms, 1e6 is Cornish-Fisher.
    const std::pair<double, double> table[] = {{1, 12.706204736432095},  {2, 4.302652729911275},    {3, 3.182446305284263},
                                               {4, 2.7764451051977987},  {7, 2.3646242510102993},   {15, 2.131449545559323},
                                               {30, 2.0422724563012373}, {1e6, 1.9599663568206845}};
    for (const auto& [dof, t] : table) {
        CAPTURE(dof);
        CHECK(std::abs(student_t_quantile(0.975, dof) - t) < 1e-8);
        CHECK(std::abs(student_t_quantile(0.025, dof) + t) < 1e-8);
        CHECK(std::abs(student_t_cdf(t, dof) - 0.975) < 1e-9);
        CHECK(student_t_factor(0.95, dof) == Approx(t).epsilon(1e-9));
    }
    CHECK(std::abs(student_t_quantile(0.975, std::numeric_limits<double>::infinity()) - 1.959963984540054) < 1e-9);
    CHECK(student_t_quantile(0.5, 3) == 0);
    // 1 and 2 degrees in closed form, from the middle to far tails
    for (const double p : {0.500001, 0.6, 0.9, 0.999, 0.999999}) {
        CAPTURE(p);
        CHECK(student_t_quantile(p, 1) == Approx(std::tan(std::numbers::pi * (p - 0.5))).epsilon(1e-9));
        CHECK(student_t_quantile(p, 2) == Approx((2 * p - 1) / std::sqrt(2 * p * (1 - p))).epsilon(1e-9));
    }
}

TEST_CASE("the distribution of Student's t agrees with an integral of its density for any degrees", "[unit][measure]") {
    for (const double dof : {0.3, 0.7, 1.0, 2.5, 3.0, 11.3, 99.9, 3000.0})
        for (const double t : {0.01, 0.5, 1.3, 2.5, 6.0}) {
            CAPTURE(dof, t);
            CHECK(std::abs(student_t_cdf(t, dof) - integrated_cdf(t, dof)) < 1e-9);
            CHECK(std::abs(student_t_cdf(-t, dof) - (1 - integrated_cdf(t, dof))) < 1e-9);
        }
}

TEST_CASE("quantile and distribution of Student's t are inverse", "[unit][measure]") {
    for (const double dof : {0.2, 1.0, 2.7, 14.0, 1e3, 1e5, 1.1e5, 1e12})
        for (const double p : {1e-6, 0.025, 0.3, 0.77, 0.9999}) {
            CAPTURE(dof, p);
            CHECK(student_t_cdf(student_t_quantile(p, dof), dof) == Approx(p).epsilon(1e-9).margin(1e-14));
        }
}

TEST_CASE("the two methods for Student's t meet where one takes over", "[unit][measure]") {
    for (const double t : {0.1, 1.0, 2.0, 5.0}) {
        CAPTURE(t);
        CHECK(std::abs(student_t_cdf(t, 99999.0) - student_t_cdf(t, 100001.0)) < 1e-9);
    }
}

TEST_CASE("impossible arguments of Student's t are errors", "[unit][measure]") {
    CHECK_THROWS_AS(student_t_quantile(0, 3), Error);
    CHECK_THROWS_AS(student_t_quantile(1, 3), Error);
    CHECK_THROWS_AS(student_t_quantile(0.5, 0), Error);
    CHECK_THROWS_AS(student_t_quantile(0.9, std::nan("")), Error);
    CHECK_THROWS_AS(student_t_factor(95, 3), Error);
    CHECK_THROWS_AS(incomplete_beta(1.5, 1, 1), Error);
}

TEST_CASE("the incomplete beta function and the F distribution agree with closed forms", "[unit][measure]") {
    CHECK(incomplete_beta(0.3, 1, 1) == Approx(0.3).epsilon(1e-12));
    CHECK(incomplete_beta(0.3, 2, 1) == Approx(0.09).epsilon(1e-12));
    CHECK(incomplete_beta(0.3, 2, 3) == Approx(1 - std::pow(0.7, 4) - 4 * 0.3 * std::pow(0.7, 3)).epsilon(1e-12));
    CHECK(incomplete_beta(0, 2, 3) == 0);
    CHECK(incomplete_beta(1, 2, 3) == 1);
    // F with 2 and d degrees: (1 + 2 f / d)^(-d / 2); with 1 and d: the two tails of t
    CHECK(f_tail(3, 2, 10) == Approx(std::pow(1.6, -5)).epsilon(1e-10));
    CHECK(f_tail(4, 1, 7) == Approx(2 * student_t_cdf(-2, 7)).epsilon(1e-10));
    CHECK(f_tail(0, 3, 4) == 1);
}

TEST_CASE("Welch-Satterthwaite degrees lie between those of the least certain term and their sum", "[unit][measure]") {
    const double one[] = {0.2}, three[] = {3.0};
    CHECK(welch_satterthwaite(one, three) == Approx(3));
    const double equal[] = {1.0, 1.0}, dofs[] = {3.0, 3.0};
    CHECK(welch_satterthwaite(equal, dofs) == Approx(8));  // 4 / (2 / 5) - 2
    const double lopsided[] = {1.0, 1e-9};
    CHECK(welch_satterthwaite(lopsided, dofs) == Approx(3));
    const double zero[] = {0.0, 0.0};
    CHECK(std::isinf(welch_satterthwaite(zero, dofs)));
}
