// Checks without chance: where values lie.

#include "draw.h"
#include "sobol_pairs.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>

namespace koksma::conformance {

namespace {

constexpr Pixel kPixel{1000, 700};

/// The place of a failure within a set of values that should fill n intervals once each; empty if they do.
std::string uneven(const Draw& draw, std::size_t d, std::size_t first, std::size_t n) {
    std::vector<std::uint8_t> hit(n, 0);
    for (std::size_t i = 0; i < n; ++i)
        if (hit[cell(draw(first + i, d), n)]++)
            return text("dimension ", d, ": two of samples [", first, ", ", first + n, ") in interval ", cell(draw(first + i, d), n), " of ", n);
    return {};
}

/// The same of points that were rotated together: equally spaced around the circle, to within two units of the last place. (An
/// edge that is no float may fall between a rotated point and its truncation.)
std::string uneven_circle(const Draw& draw, std::size_t d, std::size_t first, std::size_t n) {
    std::vector<double> units(n);
    for (std::size_t i = 0; i < n; ++i) units[i] = static_cast<double>(draw(first + i, d)) * 0x1p24;
    std::sort(units.begin(), units.end());
    for (std::size_t i = 0; i < n; ++i)
        if (!(std::abs(units[i] - units[0] - static_cast<double>(i) * 0x1p24 / static_cast<double>(n)) <= 2))
            return text("dimension ", d, ": samples [", first, ", ", first + n, ") are not equally spaced: ", units[0] * 0x1p-24, " and ",
                        units[i] * 0x1p-24);
    return {};
}

constexpr std::array<std::size_t, 16> kPrimes{2, 3, 5, 7, 11, 13, 17, 19, 23, 29, 31, 37, 41, 43, 47, 53};

Finding strata(const Subject& s) {
    const Promises& p = s.promises;
    if (p.strata_base < 2 && !p.strata_prime_bases && !p.strata_of_set) return not_applicable("promises none");
    for (std::uint64_t seed = 0; seed < 6; ++seed) {
        const Pixel pixel{static_cast<std::int32_t>(seed * 37), 5};
        if (p.strata_of_set) {
            const DimensionLayout layout = slots_2d_1d(1, 3);
            for (const std::size_t spp : {1u, 2u, 3u, 4u, 7u, 16u, 25u, 64u, 100u, 256u, 1024u, 4096u}) {
                if (!s.info().good_counts.contains(spp) || spp > s.info().max_samples) continue;
                const auto source = bind(s, layout, spp, seed);
                const Draw draw(*source, layout.slots(), pixel, 0, spp);
                for (std::size_t d = p.strata_of_pairs ? 0 : 2; d < layout.dimensions(); ++d)
                    if (const std::string where = uneven(draw, d, 0, spp); !where.empty()) return failed("seed ", seed, ", ", where);
            }
            continue;
        }
        const std::size_t most = std::min<std::uint64_t>(4096, s.info().max_samples);
        const DimensionLayout layout = slots_2d_1d(kPrimes.size() / 4, kPrimes.size() / 2);
        const auto source = bind(s, layout, most, seed);
        const Draw draw(*source, layout.slots(), pixel, 0, most);
        for (std::size_t d = 0; d < layout.dimensions(); ++d) {
            const std::size_t base = p.strata_prime_bases ? kPrimes[d] : p.strata_base;
            for (std::size_t n = base; n <= most; n *= base)
                for (std::size_t first = 0; first + n <= std::min(p.prefixes_only ? n : 4 * n, most); first += n)
                    if (const std::string where = p.strata_rotated ? uneven_circle(draw, d, first, n) : uneven(draw, d, first, n); !where.empty())
                        return failed("seed ", seed, ", ", where);
        }
    }
    return passed();
}

/// Whether samples [first, first + nx * ny) have one point of dimensions (a, b) in every cell of an nx x ny grid.
bool fills_grid(const Draw& draw, std::size_t a, std::size_t b, std::size_t first, std::size_t nx, std::size_t ny) {
    std::vector<std::uint8_t> hit(nx * ny, 0);
    for (std::size_t i = first; i < first + nx * ny; ++i)
        if (hit[cell(draw(i, a), nx) * ny + cell(draw(i, b), ny)]++) return false;
    return true;
}

Finding cells(const Subject& s) {
    if (!s.promises.cells_of_set) return not_applicable("promises none");
    const DimensionLayout layout = slots_2d_1d(3);
    for (std::uint64_t seed = 0; seed < 6; ++seed)
        for (const std::size_t n : {1u, 2u, 3u, 5u, 8u, 10u, 16u, 32u, 64u}) {
            if (n * n > s.info().max_samples) continue;
            const auto source = bind(s, layout, n * n, seed);
            const Draw draw(*source, layout.slots(), kPixel, 0, n * n);
            for (std::size_t slot = 0; slot < 3; ++slot)
                if (!fills_grid(draw, 2 * slot, 2 * slot + 1, 0, n, n))
                    return failed("seed ", seed, ", slot ", slot, ": a cell of the ", n, " x ", n, " grid has two points");
        }
    return passed();
}

Finding net(const Subject& s) {
    if (!s.promises.net_of_first_pair && !s.promises.net_of_pairs) return not_applicable("promises none");
    const int most = std::min(12, static_cast<int>(std::bit_width(s.info().max_samples)) - 1);
    const std::size_t pairs = s.promises.net_of_pairs ? 3 : 1;
    const DimensionLayout layout = slots_2d_1d(pairs);
    for (std::uint64_t seed = 0; seed < (pairs == 1 ? 8 : 4); ++seed) {
        const auto source = bind(s, layout, std::uint64_t{1} << most, seed);
        const Draw draw(*source, layout.slots(), kPixel, 0, std::size_t{1} << most);
        for (std::size_t pair = 0; pair < pairs; ++pair)
            for (int m = s.is_set() ? most : 0; m <= most; ++m)
                for (std::size_t block = 0; block < (s.promises.prefixes_only ? 1 : std::min<std::size_t>(4, std::size_t{1} << (most - m))); ++block)
                    for (int k = 0; k <= m; ++k)
                        if (!fills_grid(draw, 2 * pair, 2 * pair + 1, block << m, std::size_t{1} << k, std::size_t{1} << (m - k)))
                            return failed("seed ", seed, ", slot ", pair, ", samples [", block << m, ", ", (block + 1) << m,
                                          "): an elementary interval 2^-", k, " x 2^-", m - k, " has two points");
    }
    return passed();
}

/// The smallest t for which every elementary interval of volume 2^(t-m) holds 2^t of the first 2^m points of two dimensions.
int quality_parameter(const Draw& draw, std::size_t a, std::size_t b, int m) {
    for (int t = 0; t < m; ++t) {
        bool all_even = true;
        for (int k = 0; k <= m - t && all_even; ++k) {
            const std::size_t nx = std::size_t{1} << k, ny = std::size_t{1} << (m - t - k);
            std::vector<int> count(nx * ny, 0);
            for (std::size_t i = 0; i < std::size_t{1} << m; ++i) ++count[cell(draw(i, a), nx) * ny + cell(draw(i, b), ny)];
            all_even = std::all_of(count.begin(), count.end(), [&](int c) { return c == 1 << t; });
        }
        if (all_even) return t;
    }
    return m;
}

Finding projections(const Subject& s) {
    if (!s.promises.sobol_projections) return not_applicable("promises none");
    constexpr std::size_t kMost = 4096;
    const DimensionLayout layout = slots_2d_1d(5);
    const auto source = bind(s, layout, kMost);
    const Draw draw(*source, layout.slots(), kPixel, 0, kMost);
    for (const SobolPair& pair : kSobolPairs)
        for (std::size_t k = 0; k < pair.t.size(); ++k) {
            const int m = 4 + 2 * static_cast<int>(k);
            const int t = quality_parameter(draw, static_cast<std::size_t>(pair.a), static_cast<std::size_t>(pair.b), m);
            if (t != pair.t[k])
                return failed("dimensions ", pair.a, ", ", pair.b, ", 2^", m, " points: t = ", t, " instead of ", pair.t[k]);
        }
    return passed();
}

/// The published points of a sequence that is not randomized.
Finding points(const Subject& s) {
    if (s.promises.reference_points.empty()) return not_applicable("promises none");
    const DimensionLayout layout = slots_2d_1d(4);
    const auto source = bind(s, layout, 4096);
    for (const ReferencePoint& p : s.promises.reference_points) {
        const Draw draw(*source, layout.slots(), kPixel, p.index, 1);
        for (std::size_t d = 0; d < p.numerators.size(); ++d) {
            if (p.denominators[d] == 0) break;
            const double exact = static_cast<double>(p.numerators[d]) / static_cast<double>(p.denominators[d]);
            if (!(std::abs(static_cast<double>(draw(0, d)) - exact) < 0x1p-24))  // the last bit is the converter's
                return failed("sample ", p.index, ", dimension ", d, ": ", draw(0, d), " instead of ", exact);
        }
    }
    return passed(text(s.promises.reference_points.size(), " points agree"));
}

constexpr Check kChecks[] = {
    {"points", "unscrambled points are the published ones", points},
    {"strata", "promised one-dimensional strata hold one value each", strata},
    {"cells", "every two-dimensional slot of a square set has one point in each cell", cells},
    {"net", "promised digital nets have one point in each elementary interval", net},
    {"projections", "pairs of dimensions of the Sobol' sequence have the t of its matrices", projections},
};

}  // namespace

std::span<const Check> net_checks() noexcept { return kChecks; }

}  // namespace koksma::conformance
