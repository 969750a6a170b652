// What the compiler may not do to our arithmetic: one result for one input, whatever the ISA.

#include "multiply_add.h"

#include <koksma_catch.h>

#include <cmath>
#include <limits>

using namespace koksma::house;

#ifdef __FAST_MATH__
#error "fast-math is on"
#endif

namespace {

/// A value that the compiler does not know.
template <class T>
T opaque(T x) {
    volatile T copy = x;
    return copy;
}

}  // namespace

TEST_CASE("a product is rounded before it is added to") {
    // (1 + e)(1 - e) - 1 is -e^2; the rounded product is 1.
    const float e = std::ldexp(1.0f, -13);
    CHECK(multiply_add(1.0f + e, 1.0f - e, -1.0f) == 0.0f);
    CHECK(std::fma(opaque(1.0f + e), 1.0f - e, -1.0f) == -e * e);
    const double d = std::ldexp(1.0, -28);
    CHECK(multiply_add(1.0 + d, 1.0 - d, -1.0) == 0.0);
}

TEST_CASE("sums are not reassociated") {
    const float big = 0x1p24f;
    CHECK((opaque(big) + 1.0f) - big == 0.0f);
    CHECK((opaque(big) - big) + 1.0f == 1.0f);
}

TEST_CASE("not-a-number and infinity are seen") {
    const float nan = opaque(std::numeric_limits<float>::quiet_NaN()), infinity = opaque(std::numeric_limits<float>::infinity());
    CHECK(std::isnan(nan));
    CHECK_FALSE(nan == nan);
    CHECK(std::isinf(infinity));
    CHECK_FALSE(std::isfinite(infinity - infinity));
}

TEST_CASE("denormals are kept outside rendering") {
    CHECK(opaque(std::numeric_limits<float>::min()) * 0.5f > 0.0f);
    CHECK(opaque(std::numeric_limits<float>::denorm_min()) > 0.0f);
}
