#pragma once
// Points of a sampler for the tests of this folder.

#include <koksma/sampling/registry.h>

#include <string_view>
#include <vector>

namespace koksma::test {

/// Rows of one point set: value(d, i) is dimension d of the i-th sample.
struct Points {
    std::size_t count = 0;
    std::vector<float> values{};
    [[nodiscard]] float operator()(std::size_t d, std::size_t i) const noexcept { return values[d * count + i]; }
    /// The value times 2^24: an integer, exactly.
    [[nodiscard]] std::uint64_t bits24(std::size_t d, std::size_t i) const noexcept {
        return static_cast<std::uint64_t>(static_cast<double>((*this)(d, i)) * 0x1p24);
    }
};

/// Which points: `count` samples of one pixel from index `first` on, in slots of one arity.
struct Draw {
    std::uint64_t count = 1, first = 0, seed = 0;
    std::uint32_t dimensions = 10;
    std::uint8_t arity = 1;
    Pixel pixel{};
};

template <class S>
[[nodiscard]] Points draw(std::string_view spec, const Draw& d) {
    Registry registry;
    registry.add<S>();
    const std::vector<std::uint8_t> arities(d.dimensions / d.arity, d.arity);
    const SamplingPlan plan{.spp = d.count, .seed = d.seed, .layout = plain_layout(arities)};
    const auto source = registry.make(spec)->bind(plan);
    std::vector<SampleId> ids(d.count);
    for (std::uint64_t i = 0; i < d.count; ++i) ids[i] = {d.pixel, d.first + i};
    Points points{d.count, std::vector<float>(std::size_t{d.dimensions} * d.count)};
    source->fill(ids, plan.layout.slots(), points.values.data(), d.count);
    return points;
}

/// Whether one value of a dimension lies in each [j / cells, (j + 1) / cells); needs as many points as cells.
[[nodiscard]] inline bool one_per_stratum(const Points& p, std::size_t d, std::uint64_t cells) {
    std::vector<int> hits(cells, 0);
    for (std::size_t i = 0; i < p.count; ++i) ++hits[(p.bits24(d, i) * cells) >> 24];
    for (const int h : hits)
        if (h != 1) return false;
    return true;
}

/// Whether one point of two dimensions lies in each cell of a grid.
[[nodiscard]] inline bool one_per_cell(const Points& p, std::size_t d0, std::uint64_t n0, std::size_t d1, std::uint64_t n1) {
    std::vector<int> hits(n0 * n1, 0);
    for (std::size_t i = 0; i < p.count; ++i) ++hits[((p.bits24(d0, i) * n0) >> 24) * n1 + ((p.bits24(d1, i) * n1) >> 24)];
    for (const int h : hits)
        if (h != 1) return false;
    return true;
}

}  // namespace koksma::test
