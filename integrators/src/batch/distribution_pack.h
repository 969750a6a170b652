// DiscreteDistribution::sample for packs.

KOKSMA_MATHS_BEGIN

struct DiscreteSamplePack {
    Int32 index;
    Float probability, u;
};

namespace distribution {

using Doubles = hn::Rebind<double, hn::Half<Tag<float>>>;  // half as many lanes, as wide
using HalfFloats = hn::VFromD<hn::Half<Tag<float>>>;

/// A half pack: index (as a float), probability, rest.
struct HalfSample {
    HalfFloats index, probability, rest;
};
[[nodiscard]] inline HalfSample sample(const DiscreteDistribution& distribution, HalfFloats u) {
    const Doubles d;
    const hn::Half<Tag<float>> f;
    const std::span<const double> sums = distribution.prefix_sums();
    const auto x = hn::Mul(hn::PromoteTo(d, u), hn::Set(d, distribution.total()));
    auto below = hn::Zero(d), above = hn::Set(d, sums[0]), index = hn::Zero(d);
    for (std::uint32_t i = 0; i < distribution.last(); ++i) {
        const auto beyond = hn::Le(hn::Set(d, sums[i]), x);
        below = hn::IfThenElse(beyond, hn::Set(d, sums[i]), below);
        above = hn::IfThenElse(beyond, hn::Set(d, sums[i + 1]), above);
        index = hn::IfThenElse(beyond, hn::Set(d, static_cast<double>(i + 1)), index);
    }
    const auto width = hn::Sub(above, below);
    return {hn::DemoteTo(f, index), hn::DemoteTo(f, hn::Mul(width, hn::Set(d, distribution.inverse_total()))), hn::DemoteTo(f, hn::Div(hn::Sub(x, below), width))};
}

}  // namespace distribution

/// Distributions of more entries than this are searched lane by lane, by bisection.
inline constexpr std::uint32_t kLinearSearch = 16;

[[nodiscard]] inline DiscreteSamplePack sample_pack(const DiscreteDistribution& distribution, Mask active, Float u) {
    if (distribution.last() >= kLinearSearch) {
        NumberLanes x(u), probability(Float(0.0f));
        alignas(4 * kLanes) IntLanes index{};
        for_lanes(active, [&](int i) {
            const DiscreteSample s = distribution.sample(x.x[i]);
            index[i] = static_cast<std::int32_t>(s.index);
            probability.x[i] = s.probability;
            x.x[i] = s.u;
        });
        return {Int32::load(index), probability.pack(), x.pack()};
    }
    const Tag<float> f;
    const auto low = distribution::sample(distribution, hn::LowerHalf(u.raw)), high = distribution::sample(distribution, hn::UpperHalf(hn::Half<Tag<float>>(), u.raw));
    const Float rest = hn::Combine(f, high.rest, low.rest);
    return {to_int(Float(hn::Combine(f, high.index, low.index))), Float(hn::Combine(f, high.probability, low.probability)),
            select(rest < Float(kOneMinusUlp), select(rest > Float(0.0f), rest, Float(0.0f)), Float(kOneMinusUlp))};
}

KOKSMA_MATHS_END
