// No stream of values is another one shifted, and no two keys are equal: exact comparisons, with room only for the chance
// that two 24-bit numbers agree.

#include "draw.h"

#include <algorithm>
#include <cmath>
#include <map>

namespace koksma::conformance {

namespace {

struct Shift {
    std::int32_t x = 0, y = 0;
    std::int64_t seed = 0, index = 0, dimension = 0;
};

/// All small shifts, then large ones: powers of two at which counters are often cut, alone and against a neighbouring seed.
/// (OpenQMC 294d656: seed f + 1 at pixel x is seed f at x + 1; sample index + 65536 is the next seed; all repeats every 256 pixels.)
/// (Mitsuba's ldsampler: seed s + spp is seed s one pixel on.)
std::vector<Shift> all_shifts(std::int64_t spp) {
    std::vector<Shift> shifts{{.x = -1, .seed = spp}, {.x = 1, .seed = spp}, {.y = -1, .seed = spp}, {.y = 1, .seed = spp}};
    for (std::int32_t x = -1; x <= 1; ++x)
        for (std::int32_t y = -1; y <= 1; ++y)
            for (std::int64_t seed = -1; seed <= 1; ++seed)
                for (std::int64_t index = -1; index <= 1; ++index)
                    for (std::int64_t dimension = -1; dimension <= 1; ++dimension)
                        if (x != 0 || y != 0 || seed != 0 || index != 0 || dimension != 0) shifts.push_back({x, y, seed, index, dimension});
    for (std::int64_t seed = -1; seed <= 1; ++seed) {
        for (const std::int32_t p : {2, 16, 64, 128, 256, 512, 1024}) {
            shifts.push_back({.x = p, .seed = seed});
            shifts.push_back({.y = p, .seed = seed});
            shifts.push_back({.x = p, .y = p, .seed = seed});
        }
        for (const std::int64_t index : {2ll, 16ll, 64ll, 256ll, 1024ll, 65536ll, 1ll << 24, 1ll << 31, 1ll << 32, 1ll << 40})
            shifts.push_back({.seed = seed, .index = index});
        for (const std::int64_t dimension : {2, 3, 4, 6, 8}) shifts.push_back({.seed = seed, .dimension = dimension});
    }
    for (const std::int64_t seed : {2ll, 8ll, 256ll, 65536ll, 1ll << 31, 1ll << 32, 1ll << 62}) shifts.push_back({.seed = seed});
    return shifts;
}

Finding shifts(const Subject& s) {
    if (!s.randomized) return not_applicable("not randomized");
    constexpr Pixel kPixel{500, 300};
    constexpr std::uint64_t kSeed = 1000000, kFirst = 8;
    constexpr std::size_t kSamples = 32;
    const DimensionLayout layout = slots_2d_1d(4, 4);
    const std::uint64_t spp = good_count(s, 2048);
    std::map<std::int64_t, std::unique_ptr<SampleSource>> sources;
    const auto draw = [&](const Shift& by) {
        auto& source = sources[by.seed];
        if (!source) source = bind(s, layout, spp, kSeed + static_cast<std::uint64_t>(by.seed));
        return Draw(*source, layout.slots(), {kPixel.x + by.x, kPixel.y + by.y}, kFirst + static_cast<std::uint64_t>(by.index), kSamples);
    };
    const Draw base = draw({});
    const std::uint64_t end = s.is_set() ? spp : s.info().max_samples;
    for (const Shift& by : all_shifts(static_cast<std::int64_t>(spp))) {
        if (by.index > 0 && kFirst + static_cast<std::uint64_t>(by.index) + kSamples > end) continue;
        const bool moves_pixel_only = by.seed == 0 && by.index == 0 && by.dimension == 0;
        if (s.pixels_shared && moves_pixel_only) continue;
        const Draw shifted = draw(by);
        int equal = 0, equal_dimensions = 0;
        for (std::size_t d = 0; d < layout.dimensions(); ++d) {
            const std::int64_t e = static_cast<std::int64_t>(d) + by.dimension;
            if (e < 0 || e >= static_cast<std::int64_t>(layout.dimensions())) continue;
            int equal_here = 0;
            for (std::size_t i = 0; i < kSamples; ++i) equal_here += base(i, d) == shifted(i, static_cast<std::size_t>(e));
            equal += equal_here;
            equal_dimensions += equal_here > 0;
        }
        // 384 comparisons at 2^-24: three or more agree by chance in 2e-15 of all shifts. A digit of the index beyond the 24th
        // may lie below the last bit of a float (always in dimension 0 of a digital sequence), but not in most dimensions.
        const bool beyond_float = by.index >= 1 << 20;
        if (equal >= 3 && (!beyond_float || 2 * equal_dimensions > static_cast<int>(layout.dimensions())))
            return failed(equal, " of ", kSamples * layout.dimensions(), " values are equal under a shift of pixel (", by.x, ", ", by.y,
                          "), seed ", by.seed, ", index ", by.index, ", dimension ", by.dimension);
    }
    return passed();
}

/// Values of sample 0 that agree, against the number expected if all keys differ. Sample 0 is the scramble itself in most
/// constructions, so equal keys show as equal values even where the matrices of two dimensions differ.
/// @param resolution  how many values are told apart for sure
Finding equal_values(std::string_view over, std::vector<std::uint32_t>& values, double resolution) {
    std::sort(values.begin(), values.end());
    std::size_t pairs = 0;
    for (std::size_t i = 1; i < values.size(); ++i) pairs += values[i] == values[i - 1];
    const double n = static_cast<double>(values.size()), expected = n * n / 2 / resolution;
    const double limit = expected + 6 * std::sqrt(expected) + 6;
    const std::string numbers = text(pairs, " equal first values in ", values.size(), " ", over, ", ", expected, " expected, limit ", limit);
    return {.passed = static_cast<double>(pairs) <= limit, .numbers = numbers};
}

Finding keys(const Subject& s) {
    if (!s.randomized) return not_applicable("not randomized");
    const DimensionLayout layout = slots_2d_1d(4, 8);
    const std::uint64_t spp = good_count(s, 16);
    const auto collect = [&](std::uint64_t seed, std::int32_t side, std::vector<std::uint32_t>& values) {
        std::vector<SampleId> ids;
        for (std::int32_t y = 0; y < side; ++y)
            for (std::int32_t x = 0; x < side; ++x) ids.push_back({{x, y}, 0});
        const auto source = bind(s, layout, spp, seed);
        const Draw draw(*source, layout.slots(), ids);
        for (const float u : draw.values()) values.push_back(bits24(u));
    };
    // In base 3 there are 3^15 strata and 2^24 floats: of two floats in a stratum one is likelier, and more values agree than if all
    // floats were equally likely (measured 2351 for 2048; base 5, 5^10 strata: 2734). At most as many as there are equal strata.
    double resolution = 0x1p24;
    if (const double base = s.info().good_counts.base; s.promises.values_in_finest_strata && base > 2) {
        resolution = base;
        while (resolution * base <= 0x1p24) resolution *= base;
    }
    std::vector<std::uint32_t> values;
    for (std::uint64_t seed = 0; seed < 16384; ++seed) collect(seed, 1, values);
    if (Finding f = equal_values("(seed, dimension)", values, resolution); !f.passed) return f;
    if (!s.pixels_independent) return passed("seeds only");
    values.clear();
    collect(1, 128, values);
    if (Finding f = equal_values("(pixel, dimension)", values, resolution); !f.passed) return f;
    values.clear();
    for (std::uint64_t seed = 0; seed < 64; ++seed) collect(seed, 16, values);
    return equal_values("(seed, pixel, dimension)", values, resolution);
}

constexpr Check kChecks[] = {
    {"shifts", "no stream equals another one under a shift of pixel, seed, index or dimension", shifts},
    {"keys", "no two of all seeds, pixels and dimensions share a key", keys},
};

}  // namespace

std::span<const Check> stream_checks() noexcept { return kChecks; }

}  // namespace koksma::conformance
