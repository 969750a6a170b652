// Checks without chance: how values are drawn.

#include "draw.h"

#include <koksma/sampling/tail.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
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
        const auto source = bind(s, layout, spp, seed);
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
    const auto source = bind(s, layout, spp), again = bind(s, layout, spp);
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
    const auto reference = bind(s, layout, most);
    const Draw expected(*reference, layout.slots(), kPixel, 0, std::min<std::size_t>(64, most));
    for (const std::uint64_t spp : {1ull, 2ull, 3ull, 16ull, 100ull, 65536ull}) {
        if (spp > s.info().max_samples) continue;
        const auto source = bind(s, layout, spp);
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
            (void)bind(s, slots_2d_1d(1), most + 1);
        } catch (const Error&) {
            refused = true;
        }
        if (!refused) return failed("spp = ", most + 1, " was accepted; max_samples = ", most);
    }
    const std::uint32_t end = s.info().max_dimensions;
    if (end > 100000) return passed("no last dimension");
    const DimensionLayout layout = slots_2d_1d(end / 2 + 4);
    const std::uint64_t spp = good_count(s, 64);
    std::unique_ptr<SampleSource> source;
    try {
        source = bind(s, layout, spp, 5);
    } catch (const Error&) {
        return passed("more dimensions are refused");
    }
    const Draw draw(*source, layout.slots(), kPixel, 0, 16);
    for (const Slot& slot : layout.slots())
        for (std::uint32_t k = 0; k < slot.arity && slot.dimension + slot.arity > end; ++k)
            for (std::size_t i = 0; i < 16; ++i)
                if (draw(i, slot.dimension + k) != tail_sample(s.first_seed + 5, {kPixel, i}, slot.bounce, slot.role, k))
                    return failed("dimension ", slot.dimension + k, " of sample ", i, " is not the tail's");
    return passed();
}

Finding repeats(const Subject& s) {
    const DimensionLayout layout = slots_2d_1d(3);
    const std::uint64_t spp = good_count(s, 4096);
    const auto source = bind(s, layout, spp);
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
    const auto source = bind(s, layout, spp, 1), other = bind(s, layout, spp, 2);
    const Draw here(*source, layout.slots(), kPixel, 0, spp), there(*source, layout.slots(), Pixel{3, 1999}, 0, spp);
    if (s.pixels_shared && here.values() != there.values()) return failed("pixels=shared, but two pixels differ");
    if (!s.randomized && Draw(*other, layout.slots(), kPixel, 0, spp).values() != here.values())
        return failed("not randomized, but two seeds differ");
    return passed();
}

/// Values of four samples, in all dimensions up to the sampler's last (5000 if it has none): no dimension is another one again.
/// (pbrt wraps to dimension 2 after 1024 of Sobol' and 1000 of Halton.)
Finding dimensions(const Subject& s) {
    const std::uint32_t end = std::min<std::uint32_t>(s.info().max_dimensions, 5000);
    const DimensionLayout layout = slots_2d_1d(end / 2);
    const std::uint64_t spp = good_count(s, 4096), last = (s.is_set() ? spp : s.info().max_samples) - 1;
    std::vector<SampleId> ids;  // many digits set: unscrambled values of few digits agree in many dimensions
    for (const std::uint64_t i : {0xdb6dabull, 0xb7ed57ull, 0x75dbebull, 0xedb6ddull}) ids.push_back({kPixel, last < 0xffffffull ? i % (last + 1) : i});
    const auto source = bind(s, layout, spp);
    const Draw draw(*source, layout.slots(), ids);
    std::map<std::array<float, 4>, std::size_t> seen;
    for (std::size_t d = 0; d < draw.dimensions(); ++d) {
        const auto [at, is_new] = seen.emplace(std::array{draw(0, d), draw(1, d), draw(2, d), draw(3, d)}, d);
        if (!is_new) return failed("dimension ", d, " has the values of dimension ", at->second);
    }
    return passed(text(draw.dimensions(), " dimensions differ"));
}

/// A sequence without groups has one value a dimension, however slots are cut.
Finding access(const Subject& s) {
    if (s.info().joint != 0) return not_applicable("values depend on how slots are grouped");
    const std::uint64_t spp = good_count(s, 64);
    const DimensionLayout pairs = slots_2d_1d(4), singles = slots_2d_1d(0, 8);
    const auto by_two = bind(s, pairs, spp), by_one = bind(s, singles, spp);
    for (const Pixel pixel : {kPixel, Pixel{0, 0}})
        if (Draw(*by_two, pairs.slots(), pixel, 0, spp).values() != Draw(*by_one, singles.slots(), pixel, 0, spp).values())
            return failed("values drawn two at a time differ from values drawn one at a time");
    return passed();
}

constexpr Check kChecks[] = {
    {"range", "all values lie in [0, 1), at extreme seeds, pixels and indices too; multiples of 2^-24 if promised", range},
    {"order", "values do not depend on binding, order, batch, stride or part of the run", order},
    {"prefix", "values of a sequence do not depend on the plan's spp", prefix},
    {"limits", "plans beyond a limit are refused, dimensions beyond the last come from the tail", limits},
    {"repeats", "no point occurs twice", repeats},
    {"dimensions", "no dimension repeats another one", dimensions},
    {"access", "a dimension has one value, drawn alone or in a pair", access},
    {"sharing", "shared pixels are equal, and without randomization seeds are too", sharing},
};

}  // namespace

std::span<const Check> exact_checks() noexcept { return kChecks; }

}  // namespace koksma::conformance
