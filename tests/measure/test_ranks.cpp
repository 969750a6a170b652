#include "laws.h"

#include <koksma/measure/ratio.h>
#include <koksma_catch.h>

#include <cmath>
#include <limits>
#include <vector>

using namespace koksma;
using namespace koksma::test;

namespace {

Comparison with_p(double p) {
    Comparison c;
    c.p = p;
    return c;
}

}  // namespace

TEST_CASE("Holm's p values are those of the paper's procedure", "[unit][measure]") {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    std::vector<Comparison> family = {with_p(0.04), with_p(0.01), with_p(nan), with_p(0.03), with_p(0.005)};
    holm(family);
    CHECK(family[4].p_holm == Approx(0.02));
    CHECK(family[1].p_holm == Approx(0.03));
    CHECK(family[3].p_holm == Approx(0.06));
    CHECK(family[0].p_holm == Approx(0.06));  // 0.04, but never less than a smaller p's
    CHECK(std::isnan(family[2].p_holm));
    CHECK(family[1].distinguishable());
    CHECK_FALSE(family[3].distinguishable());
    CHECK_FALSE(family[2].distinguishable());
}

TEST_CASE("p is below 5 percent exactly where the 95 percent interval excludes 1", "[unit][measure]") {
    Generator g(7);
    int apart = 0;
    for (int i = 0; i < 200; ++i) {
        const std::vector<double> a = replicates(chi2_law(0.25), 8, 1, g), b = replicates(chi2_law(0.25), 8, 1.3, g);
        const Comparison c = compare_errors(a, b);
        CAPTURE(i, c.p, c.gain.lo, c.gain.hi);
        CHECK((c.p < 0.05) == c.gain.distinguishable());
        apart += c.gain.distinguishable();
    }
    CHECK(apart > 50);
    CHECK(apart < 150);
}

TEST_CASE("of ten equal samplers some pair seems to differ, after Holm hardly ever", "[unit][measure]") {
    constexpr int kFamilies = 200;
    int plain = 0, corrected = 0;
    Generator g(11);
    for (int i = 0; i < kFamilies; ++i) {
        std::vector<std::vector<double>> samplers;
        for (int k = 0; k < 6; ++k) samplers.push_back(replicates(chi2_law(0.1), 8, 1, g));
        std::vector<Comparison> family;
        for (std::size_t a = 0; a < samplers.size(); ++a)
            for (std::size_t b = a + 1; b < samplers.size(); ++b) family.push_back(compare_errors(samplers[a], samplers[b]));
        holm(family);
        bool any = false, any_corrected = false;
        for (const Comparison& c : family) {
            any = any || c.p < 0.05;
            any_corrected = any_corrected || c.distinguishable();
        }
        plain += any;
        corrected += any_corrected;
    }
    CAPTURE(plain, corrected);
    CHECK(plain > 0.25 * kFamilies);
    CHECK(corrected < 0.09 * kFamilies);  // 0.05 and two and a half standard deviations of 200 trials
}

TEST_CASE("a comparison without replicates or above no floor has no p", "[unit][measure]") {
    const double one[] = {1.0}, many[] = {3.0, 3.1, 2.9}, negative[] = {-1.0, 0.5};
    CHECK(std::isnan(compare_errors(one, one).p));
    CHECK(std::isnan(compare_errors(many, negative).p));
    CHECK(compare_errors(many, many).p == 1);
    const double far[] = {30.0, 31.0, 29.0};
    CHECK(compare_errors(many, far).p < 1e-3);
}
