// permutation.h and strata for packs. No include guard: read anew for each instruction set, after fill_packs.h and the two.

#include <koksma/simd/half_words.h>

KOKSMA_MATHS_BEGIN

/// The numbers of all rounds of `permute` at once: that of round r is key * times + plus.
struct PermuteJump {
    std::uint64_t times = 1, plus = 0;
};
struct PermuteJumps {
    PermuteJump of[kPermuteRounds];
    constexpr PermuteJumps() : of{} {
        PermuteJump j;
        for (PermuteJump& round : of) {
            j = {j.times * 0xd1342543de82ef95ull, j.plus * 0xd1342543de82ef95ull + 0x2545f4914f6cdd1dull};
            round = j;
        }
    }
    constexpr const PermuteJump& operator[](int round) const { return of[round]; }
};
inline constexpr PermuteJumps kPermuteJumps;

/// One number a sample of a block.
struct BlockArray {
    alignas(64) std::uint32_t of[kBlockSamples];
};

/// The permutations of [0, n), n up to kMostStrataOfPacks (permutation.h), of the pixels of a block, taken apart into the numbers of their rounds.
class PermutationTable {
public:
    /// @param keys     of the pixels
    /// @param counter  the permutation of a pixel is that of derive_key(its key, counter)
    HWY_INLINE void set(const SampleBlock& block, const PixelKeyArray& keys, std::uint64_t counter, std::uint32_t n) {
        n_ = n;
        const int bits = std::bit_width(n - 1);
        mask_ = (1u << bits) - 1;
        shift_ = (bits + 1) / 2;
        for (std::size_t p = 0; p < block.pixels; ++p) {
            const Key key = derive_key(keys[p], counter);
            for (int round = 0; round < kPermuteRounds; ++round) {
                const std::uint64_t k = join_key(key) * kPermuteJumps[round].times + kPermuteJumps[round].plus;
                plus_[round].of[p] = doubled(k >> 32);
                times_[round].of[p] = doubled((k >> 1) | 1u);
            }
            rotation_.of[p] = static_cast<std::uint32_t>((std::uint64_t{koksma::keyed_hash(key, 0)} * n) >> 32);
        }
    }
    /// The images y of the numbers x, below n, of a block under each table's permutations. The rounds of a permutation are one
    /// long chain of multiplications: four packs of samples and two tables together hide what each waits for.
    template <int tables>
    static HWY_INLINE void images(const SampleBlock& block, const PermutationTable* table, const BlockArray* const (&x)[tables],
                                  BlockArray* const (&y)[tables]) {
        for (std::size_t i = 0; i < block.count; i += 4 * kPack) {
            const std::size_t last = (block.count - 1) / kPack * kPack;
            const std::size_t at[4] = {i, std::min(i + kPack, last), std::min(i + 2 * kPack, last), std::min(i + 3 * kPack, last)};
            bool one_pixel = true;
            for (int j = 0; j < 4; ++j) one_pixel = one_pixel && block.lane[at[j] + kPack - 1] == 0 && block.first[at[j] / kPack] == block.first[i / kPack];
            if (one_pixel)
                images_at<true, tables>(block, at, table, x, y);
            else
                images_at<false, tables>(block, at, table, x, y);
        }
    }

    /// The same of one array under one or two tables.
    static HWY_INLINE void images_of(std::size_t tables, const SampleBlock& block, const PermutationTable (&table)[2], const BlockArray& x, BlockArray (&y)[2]) {
        if (tables == 2)
            images<2>(block, table, {&x, &x}, {&y[0], &y[1]});
        else
            images<1>(block, table, {&x}, {&y[0]});
    }

private:
    [[nodiscard]] static HWY_INLINE std::uint32_t doubled(std::uint64_t x) { return static_cast<std::uint32_t>(x & 0xffffu) * 0x10001u; }
    /// Four packs of samples.
    struct Four {
        HalfWords a, b;
        [[nodiscard]] static HWY_INLINE Four of(const UInt32 (&x)[4]) { return {HalfWords::of(x[0], x[1]), HalfWords::of(x[2], x[3])}; }
        HWY_INLINE void split(UInt32 (&x)[4]) const { x[0] = a.first(), x[1] = a.second(), x[2] = b.first(), x[3] = b.second(); }
    };
    /// What a table of doubled numbers has for the pixels of four packs.
    template <bool one_pixel>
    [[nodiscard]] static HWY_INLINE Four numbers(const SampleBlock& block, const PixelTable& t, const std::size_t (&at)[4]) {
        if constexpr (one_pixel) {
            const UInt32 x = t.of[block.first[at[0] / kPack]];
            return {HalfWords::of_doubled(x, x), HalfWords::of_doubled(x, x)};
        } else {
            return {HalfWords::of_doubled(block.of_pixel(t, at[0]), block.of_pixel(t, at[1])),
                    HalfWords::of_doubled(block.of_pixel(t, at[2]), block.of_pixel(t, at[3]))};
        }
    }
    template <bool one_pixel, int tables>
    static HWY_INLINE void rounds(const SampleBlock& block, const std::size_t (&at)[4], const PermutationTable* table, Four* x) {
        for (int round = 0; round < kPermuteRounds; ++round)
            for (int t = 0; t < tables; ++t) {
                const UInt32 bits = table[t].mask_ * 0x10001u;
                const HalfWords mask = HalfWords::of_doubled(bits, bits);
                const Four plus = numbers<one_pixel>(block, table[t].plus_[round], at), times = numbers<one_pixel>(block, table[t].times_[round], at);
                x[t].a = ((x[t].a + plus.a) * times.a) & mask;
                x[t].b = ((x[t].b + plus.b) * times.b) & mask;
                x[t].a = x[t].a ^ shift_right(x[t].a, table[t].shift_);
                x[t].b = x[t].b ^ shift_right(x[t].b, table[t].shift_);
            }
    }
    template <bool one_pixel, int tables>
    static HWY_INLINE void images_at(const SampleBlock& block, const std::size_t (&at)[4], const PermutationTable* table,
                                     const BlockArray* const (&from)[tables], BlockArray* const (&to)[tables]) {
        UInt32 image[tables][4];
        Four x[tables];
        for (int t = 0; t < tables; ++t) {
            for (int j = 0; j < 4; ++j) image[t][j] = UInt32::load(from[t]->of + at[j]);
            x[t] = Four::of(image[t]);
        }
        rounds<one_pixel, tables>(block, at, table, x);
        for (int t = 0; t < tables; ++t) {
            const std::uint32_t n = table[t].n_;
            const UInt32 last = n - 1;
            x[t].split(image[t]);
            while (n <= table[t].mask_ && any(image[t][0] > last || image[t][1] > last || image[t][2] > last || image[t][3] > last)) {
                Four further = Four::of(image[t]);
                rounds<one_pixel, 1>(block, at, table + t, &further);
                UInt32 next[4];
                further.split(next);
                for (int j = 0; j < 4; ++j) image[t][j] = select(image[t][j] > last, next[j], image[t][j]);
            }
            const PixelTable& rotation = table[t].rotation_;
            for (int j = 0; j < 4; ++j) {
                const UInt32 y = image[t][j] + (one_pixel ? UInt32(rotation.of[block.first[at[0] / kPack]]) : block.of_pixel(rotation, at[j]));
                min(y, y - UInt32(n)).store(to[t]->of + at[j]);
            }
        }
    }
    std::uint32_t n_, mask_;
    int shift_;
    PixelTable plus_[kPermuteRounds], times_[kPermuteRounds], rotation_;
};

/// x / n and x mod n of a block, for x below 2^21: (x + 1/2) / n is further from an integer than the rounding of the product.
HWY_INLINE void divide(const SampleBlock& block, const BlockArray& x, std::uint32_t n, BlockArray& quotient, BlockArray& remainder) {
    const Float inverse = 1.0f / static_cast<float>(n);
    for (std::size_t i = 0; i < block.count; i += kPack) {
        const UInt32 number = UInt32::load(x.of + i), q = as_uint(to_int((to_real(as_int(number)) + Float(0.5f)) * inverse));
        q.store(quotient.of + i);
        (number - q * UInt32(n)).store(remainder.of + i);
    }
}
/// n equal strata of [0, 1), and the jitter within.
struct StrataPack {
    std::uint32_t n;
    double scale;
    int bits;  ///< n = 2^bits, or -1
    HWY_INLINE explicit StrataPack(std::uint32_t count)
        : n(count), scale(0x1p24 / count), bits(std::has_single_bit(count) && count <= kMostStrataOfPacks ? std::countr_zero(count) : -1) {}
    [[nodiscard]] HWY_INLINE Float place(UInt32 stratum, UInt32 jitter) const {
        if (bits < 0) return stratum_float(stratum, n, scale, fraction(jitter));
        // All steps of stratum_float are exact: digits of the stratum, then digits of the jitter.
        return unit_float24(shift_left(stratum, UInt32(static_cast<std::uint32_t>(24 - bits))) + shift_right(jitter, UInt32(static_cast<std::uint32_t>(8 + bits))));
    }
};

/// What samplers of kind `set` need of a block: indices modulo spp, and the keys of the jitters.
struct SetBlock : SampleBlock {
    BlockArray index_in_set;
    SampleKeyArray jitter;
    PixelKeyArray slots;  ///< derive_key(key of the pixel, slot_keys)

    template <class KeyOf>
    HWY_INLINE void read_set(std::span<const SampleId> samples, KeyOf key_of, std::uint64_t slot_keys, std::uint32_t count_in_set) {
        read(samples, key_of);
        derive_sample_keys(keys, jitter);
        derive_pixel_keys(keys, slot_keys, slots);
        const bool modulo = SampleBlock::any >= count_in_set;  // or less
        for (std::size_t i = 0; i < kBlockSamples; ++i) index_in_set.of[i] = low[i];
        if (modulo)
            for (std::size_t i = 0; i < count; ++i) index_in_set.of[i] = static_cast<std::uint32_t>(index[i] % count_in_set);
        for (std::size_t i = count; i % kPack != 0; ++i) index_in_set.of[i] = index_in_set.of[i - 1];
    }
};

KOKSMA_MATHS_END
