// Integers become floats in [0, 1), and floats stay in their strata.

#include <koksma/sampling/bits.h>
#include <samplers/stratum.h>

#include <koksma_catch.h>

using namespace koksma;

TEST_CASE("No 32-bit integer becomes 1", "[unit][samplers]") {
    for (std::uint32_t below = 0; below < 1024; ++below) REQUIRE(unit_float(0xffffffffu - below) < 1.0f);
    REQUIRE(unit_float(0xffffffffu) == kOneMinusUlp);
    REQUIRE(unit_float_ceil(~0ull >> 2, (~0ull >> 2) + 1) == kOneMinusUlp);
}

TEST_CASE("A jittered value never leaves its stratum, whatever the count and the jitter", "[unit][samplers]") {
    const double edges[] = {0.0, 0x1p-32, 0.5, 1.0 - 0x1p-24, 1.0 - 0x1p-32};
    const auto holds = [&](std::uint64_t stratum, std::uint64_t count) {
        for (const double u : edges) {
            const float x = stratum_float(stratum, count, 0x1p24 / static_cast<double>(count), u);
            const auto k = static_cast<std::uint64_t>(static_cast<double>(x) * 0x1p24);
            if (!(x < 1.0f) || k * count < stratum << 24 || k * count >= (stratum + 1) << 24) return false;
        }
        return true;
    };
    for (std::uint64_t count = 1; count <= 300; ++count)
        for (std::uint64_t s = 0; s < count; ++s) REQUIRE(holds(s, count));
    for (const std::uint64_t count : {4782969ull, 14348907ull, 16777213ull, 16777216ull, 1048576ull, 1000003ull})
        for (std::uint64_t s = 0; s < count; s += 1 + count / 5000) REQUIRE((holds(s, count) && holds(count - 1 - s, count)));
}
