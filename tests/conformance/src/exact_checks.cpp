// Checks without chance: how values are drawn, and where they lie.

#include "draw.h"
#include "sobol_pairs.h"

#include <koksma/sampling/tail.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <random>

namespace koksma::conformance {

namespace {

constexpr Pixel kPixel{1000, 700};

/// Indices at which integer widths end, as far as the sampler goes.
std::vector<SampleId> far_samples(const Subject& s, std::uint64_t spp) {
    const std::uint64_t end = s.is_set() ? spp : s.info().max_samples;
    std::vector<SampleId> ids;
    for (const Pixel p : {Pixel{0, 0}, Pixel{2047, 2047}, kPixel})
        for (const std::uint64_t i : {0ull, 1ull, 255ull, 65535ull, 65536ull, (1ull << 24) - 1, (1ull << 31) - 1, 1ull << 31, (1ull << 32) - 1,
                                      1ull << 32, (1ull << 40) + 12345, (1ull << 63) - 1, ~0ull})
            ids.push_back({p, std::min(i, end - 1)});
    return ids;
}

Finding range(const Subject& s) {
    const DimensionLayout layout = slots_2d_1d(20, 20);
    const std::uint64_t spp = good_count(s, 4096);
    for (const std::uint64_t seed : {0ull, 1ull, 0x8000000000000000ull, ~0ull}) {
        const auto source = s.factory->bind(make_plan(layout, spp, seed));
        for (const Draw& draw : {Draw(*source, layout.slots(), kPixel, 0, spp), Draw(*source, layout.slots(), far_samples(s, spp))})
            for (const float u : draw.values()) {
                if (!(u >= 0.0f && u < 1.0f)) return failed("seed ", seed, ": ", u, " is outside [0, 1)");
                if (s.promises.multiples_of_2_24 && u * 0x1p24f != std::floor(u * 0x1p24f))
                    return failed("seed ", seed, ": ", u, " is not a multiple of 2^-24");
            }
    }
    return passed();
}

/// Two bindings, any order, any batch size, any stride, any part of the run.
Finding order(const Subject& s) {
    const DimensionLayout layout = slots_2d_1d(3, 2);
    const std::uint64_t spp = good_count(s, 64);
    const auto source = s.factory->bind(make_plan(layout, spp)), again = s.factory->bind(make_plan(layout, spp));
    std::vector<SampleId> ids;
    for (const Pixel p : {kPixel, Pixel{1001, 700}, Pixel{0, 3}})
        for (std::uint64_t i = 0; i < spp; ++i) ids.push_back({p, i});
    const Draw whole(*source, layout.slots(), ids);

    std::vector<std::size_t> shuffled(ids.size());
    std::iota(shuffled.begin(), shuffled.end(), std::size_t{0});
    std::shuffle(shuffled.begin(), shuffled.end(), std::mt19937(7));
    std::vector<float> out;
    for (std::size_t begin = 0, batch = 1; begin < ids.size(); begin += batch, batch = batch % 37 + 1) {
        const std::size_t n = std::min(batch, ids.size() - begin), stride = n + batch % 5;
        std::vector<SampleId> part;
        for (std::size_t i = 0; i < n; ++i) part.push_back(ids[shuffled[begin + i]]);
        for (std::size_t first = 0; first < layout.slots().size(); ++first) {
            const SlotRun run = layout.slots().subspan(first, batch % 2 == 0 ? 1 : layout.slots().size() - first);
            out.assign(dimension_count(run) * stride, -1.0f);
            again->fill(part, run, out.data(), stride);
            for (std::size_t d = 0; d < dimension_count(run); ++d)
                for (std::size_t i = 0; i < stride; ++i) {
                    const float expected = i < n ? whole(shuffled[begin + i], run.front().dimension + d) : -1.0f;
                    if (out[d * stride + i] != expected)
                        return failed("dimension ", run.front().dimension + d, ", place ", i, " of a batch of ", n, " with stride ", stride,
                                      ": ", out[d * stride + i], " instead of ", expected);
                }
        }
    }
    return passed();
}

Finding prefix(const Subject& s) {
    if (s.is_set()) return not_applicable("a set");
    const DimensionLayout layout = slots_2d_1d(4, 4);
    const std::uint64_t most = std::min<std::uint64_t>(4096, s.info().max_samples);
    const auto reference = s.factory->bind(make_plan(layout, most));
    const Draw expected(*reference, layout.slots(), kPixel, 0, std::min<std::size_t>(64, most));
    for (const std::uint64_t spp : {1ull, 2ull, 3ull, 16ull, 100ull, 65536ull}) {
        if (spp > s.info().max_samples) continue;
        const auto source = s.factory->bind(make_plan(layout, spp));
        if (Draw(*source, layout.slots(), kPixel, 0, expected.count()).values() != expected.values())
            return failed("values for spp = ", spp, " differ from those for spp = ", most);
    }
    return passed();
}

/// A plan beyond a limit is refused; slots beyond the last dimension are the tail's, bit for bit.
Finding limits(const Subject& s) {
    const std::uint64_t most = s.info().max_samples;
    if (most != std::numeric_limits<std::uint64_t>::max()) {
        bool refused = false;
        try {
            (void)s.factory->bind(make_plan(slots_2d_1d(1), most + 1));
        } catch (const Error&) {
            refused = true;
        }
        if (!refused) return failed("spp = ", most + 1, " was accepted; max_samples = ", most);
    }
    const std::uint32_t end = s.info().max_dimensions;
    if (end > 100000) return passed("no last dimension");
    const DimensionLayout layout = slots_2d_1d(end / 2 + 4);
    const std::uint64_t spp = good_count(s, 64);
    const auto source = s.factory->bind(make_plan(layout, spp, 5));
    const Draw draw(*source, layout.slots(), kPixel, 0, 16);
    for (const Slot& slot : layout.slots())
        for (std::uint32_t k = 0; k < slot.arity && slot.dimension + slot.arity > end; ++k)
            for (std::size_t i = 0; i < 16; ++i)
                if (draw(i, slot.dimension + k) != tail_sample(5, {kPixel, i}, slot.bounce, slot.role, k))
                    return failed("dimension ", slot.dimension + k, " of sample ", i, " is not the tail's");
    return passed();
}

/// The place of a failure within a set of values that should fill n intervals once each; empty if they do.
std::string uneven(const Draw& draw, std::size_t d, std::size_t first, std::size_t n) {
    std::vector<std::uint8_t> hit(n, 0);
    for (std::size_t i = 0; i < n; ++i)
        if (hit[cell(draw(first + i, d), n)]++)
            return text("dimension ", d, ": two of samples [", first, ", ", first + n, ") in interval ", cell(draw(first + i, d), n), " of ", n);
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
                if (!s.info().good_counts.contains(spp)) continue;
                const auto source = s.factory->bind(make_plan(layout, spp, seed));
                const Draw draw(*source, layout.slots(), pixel, 0, spp);
                for (std::size_t d = 2; d < layout.dimensions(); ++d)
                    if (const std::string where = uneven(draw, d, 0, spp); !where.empty()) return failed("seed ", seed, ", ", where);
            }
            continue;
        }
        const std::size_t most = std::min<std::uint64_t>(4096, s.info().max_samples);
        const DimensionLayout layout = slots_2d_1d(kPrimes.size() / 2);
        const auto source = s.factory->bind(make_plan(layout, most, seed));
        const Draw draw(*source, layout.slots(), pixel, 0, most);
        for (std::size_t d = 0; d < layout.dimensions(); ++d) {
            const std::size_t base = p.strata_prime_bases ? kPrimes[d] : p.strata_base;
            for (std::size_t n = base; n <= most; n *= base)
                for (std::size_t first = 0; first + n <= std::min(4 * n, most); first += n)
                    if (const std::string where = uneven(draw, d, first, n); !where.empty()) return failed("seed ", seed, ", ", where);
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
            const auto source = s.factory->bind(make_plan(layout, n * n, seed));
            const Draw draw(*source, layout.slots(), kPixel, 0, n * n);
            for (std::size_t slot = 0; slot < 3; ++slot)
                if (!fills_grid(draw, 2 * slot, 2 * slot + 1, 0, n, n))
                    return failed("seed ", seed, ", slot ", slot, ": a cell of the ", n, " x ", n, " grid has two points");
        }
    return passed();
}

Finding net(const Subject& s) {
    if (!s.promises.net_of_first_pair) return not_applicable("promises none");
    constexpr int kMost = 12;
    const DimensionLayout layout = slots_2d_1d(1);
    for (std::uint64_t seed = 0; seed < 8; ++seed) {
        const auto source = s.factory->bind(make_plan(layout, 1u << kMost, seed));
        const Draw draw(*source, layout.slots(), kPixel, 0, 1u << kMost);
        for (int m = 0; m <= kMost; ++m)
            for (std::size_t block = 0; block < std::min<std::size_t>(4, std::size_t{1} << (kMost - m)); ++block)
                for (int k = 0; k <= m; ++k)
                    if (!fills_grid(draw, 0, 1, block << m, std::size_t{1} << k, std::size_t{1} << (m - k)))
                        return failed("seed ", seed, ", samples [", block << m, ", ", (block + 1) << m, "): an elementary interval 2^-", k,
                                      " x 2^-", m - k, " has two points");
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
    const auto source = s.factory->bind(make_plan(layout, kMost));
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

Finding repeats(const Subject& s) {
    const DimensionLayout layout = slots_2d_1d(3);
    const std::uint64_t spp = good_count(s, 4096);
    const auto source = s.factory->bind(make_plan(layout, spp));
    const Draw draw(*source, layout.slots(), kPixel, 0, spp);
    for (std::size_t d = 0; d < 6; d += 2) {
        std::vector<std::uint64_t> points;
        for (std::size_t i = 0; i < spp; ++i) points.push_back((std::uint64_t{bits24(draw(i, d))} << 32) | bits24(draw(i, d + 1)));
        std::sort(points.begin(), points.end());
        if (std::adjacent_find(points.begin(), points.end()) != points.end())
            return failed("two of ", spp, " samples have the same point in dimensions ", d, ", ", d + 1);
    }
    return passed();
}

/// What a choice of options says about seeds and pixels.
Finding sharing(const Subject& s) {
    const DimensionLayout layout = slots_2d_1d(3, 1);
    const std::uint64_t spp = good_count(s, 64);
    const auto source = s.factory->bind(make_plan(layout, spp, 1)), other = s.factory->bind(make_plan(layout, spp, 2));
    const Draw here(*source, layout.slots(), kPixel, 0, spp), there(*source, layout.slots(), Pixel{3, 1999}, 0, spp);
    if (s.pixels_shared && here.values() != there.values()) return failed("pixels=shared, but two pixels differ");
    if (!s.randomized && Draw(*other, layout.slots(), kPixel, 0, spp).values() != here.values())
        return failed("not randomized, but two seeds differ");
    return passed();
}

constexpr Check kChecks[] = {
    {"range", "all values lie in [0, 1), at extreme seeds, pixels and indices too; multiples of 2^-24 if promised", range},
    {"order", "values do not depend on binding, order, batch, stride or part of the run", order},
    {"prefix", "values of a sequence do not depend on the plan's spp", prefix},
    {"limits", "plans beyond a limit are refused, dimensions beyond the last come from the tail", limits},
    {"strata", "promised one-dimensional strata hold one value each", strata},
    {"cells", "every two-dimensional slot of a square set has one point in each cell", cells},
    {"net", "dimensions 0 and 1 have one point in each elementary interval", net},
    {"projections", "pairs of dimensions of the Sobol' sequence have the t of its matrices", projections},
    {"repeats", "no point occurs twice", repeats},
    {"sharing", "shared pixels are equal, and without randomization seeds are too", sharing},
};

}  // namespace

std::span<const Check> exact_checks() noexcept { return kChecks; }

}  // namespace koksma::conformance
