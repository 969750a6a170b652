// DiscreteDistribution::sample for packs.

KOKSMA_MATHS_BEGIN

struct DiscreteSamplePack {
    Int32 index;
    Float probability, u;
};

/// An entry, and where it lies among the prefix sums.
struct DiscreteEntryPack {
    Int32 index;
    Double below, width;
};

[[nodiscard]] inline DiscreteEntryPack entry_of(const DiscreteDistribution& distribution, Double x) {
    const double* sums = distribution.prefix_sums().data();
    // The first entry whose sum is above x, or the last that can be chosen.
    Int32 low(0), high(static_cast<std::int32_t>(distribution.last()));
    for (std::uint32_t left = distribution.last(); left != 0; left >>= 1) {
        const Int32 middle = shift_right<1>(low + high);
        const Mask beyond = Double::gather(sums, middle) <= x;
        low = select(beyond & (low < high), middle + Int32(1), low);
        high = select(beyond, high, middle);
    }
    const Mask first = low == Int32(0);
    const Double below = Double::of(select(first, Int32(0), Int32(1))) * Double::gather(sums, select(first, low, low - Int32(1)));
    return {low, below, Double::gather(sums, low) - below};
}

[[nodiscard]] inline DiscreteSamplePack sample_pack(const DiscreteDistribution& distribution, Float u) {
    const Double x = Double::of(u) * Double::of(distribution.total());
    const DiscreteEntryPack entry = entry_of(distribution, x);
    const Float rest = ((x - entry.below) / entry.width).rounded();
    return {entry.index, (entry.width * Double::of(distribution.inverse_total())).rounded(),
            select(rest < Float(kOneMinusUlp), select(rest > Float(0.0f), rest, Float(0.0f)), Float(kOneMinusUlp))};
}

KOKSMA_MATHS_END
