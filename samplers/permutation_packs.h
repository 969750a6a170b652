// permutation.h and strata for packs. No include guard: read anew for each instruction set, after fill_packs.h and the two.

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

/// The permutations of [0, n) of the pixels of a block, taken apart into the numbers of their rounds.
class PermutationTable {
public:
    /// @param keys     of the pixels
    /// @param counter  the permutation of a pixel is that of derive_key(its key, counter)
    HWY_INLINE void set(const SampleBlock& block, const PixelKeyArray& keys, std::uint64_t counter, std::uint32_t n) {
        n_ = n;
        if (n <= 1) return;
        mask_ = 0xffffffffu >> std::countl_zero(n - 1);
        shift_ = (std::bit_width(n - 1) + 1) / 2;
        for (std::size_t p = 0; p < block.pixels; ++p) {
            const Key key = derive_key(keys[p], counter);
            for (int round = 0; round < kPermuteRounds; ++round) {
                const std::uint64_t k = join_key(key) * kPermuteJumps[round].times + kPermuteJumps[round].plus;
                plus_[round].of[p] = static_cast<std::uint32_t>(k >> 32);
                times_[round].of[p] = static_cast<std::uint32_t>(k >> 1) | 1u;
            }
            rotation_.of[p] = static_cast<std::uint32_t>((std::uint64_t{koksma::keyed_hash(key, 0)} * n) >> 32);
        }
    }
    /// The images of the numbers x, below n, of a block under the permutations of its pixels. The rounds are one long chain of
    /// multiplications, so four packs go through them at a time.
    HWY_INLINE void images(const SampleBlock& block, const std::uint32_t* x, std::uint32_t* y) const {
        for (std::size_t i = 0; i < block.count; i += 4 * kPack) {
            const std::size_t last = (block.count - 1) / kPack * kPack;
            const std::size_t at[4] = {i, std::min(i + kPack, last), std::min(i + 2 * kPack, last), std::min(i + 3 * kPack, last)};
            bool one_pixel = true;
            for (int j = 0; j < 4; ++j) one_pixel = one_pixel && block.lane[at[j] + kPack - 1] == 0;
            if (n_ <= 1)
                for (int j = 0; j < 4; ++j) UInt32(0u).store(y + at[j]);
            else if (one_pixel)
                images_at<true>(block, at, x, y);
            else
                images_at<false>(block, at, x, y);
        }
    }

private:
    template <bool one_pixel>
    [[nodiscard]] static HWY_INLINE UInt32 number(const SampleBlock& block, const PixelTable& t, std::size_t i) {
        return one_pixel ? UInt32(t.of[block.first[i / kPack]]) : block.of_pixel(t, i);
    }
    template <bool one_pixel>
    HWY_INLINE void rounds(const SampleBlock& block, const std::size_t (&at)[4], UInt32 (&x)[4]) const {
        for (int round = 0; round < kPermuteRounds; ++round)
            for (int j = 0; j < 4; ++j) {
                x[j] = ((x[j] + number<one_pixel>(block, plus_[round], at[j])) * number<one_pixel>(block, times_[round], at[j])) & UInt32(mask_);
                x[j] = x[j] ^ shift_right(x[j], shift_);
            }
    }
    template <bool one_pixel>
    HWY_INLINE void images_at(const SampleBlock& block, const std::size_t (&at)[4], const std::uint32_t* from, std::uint32_t* to) const {
        const UInt32 n = n_, last = n_ - 1;
        UInt32 x[4] = {UInt32::load(from + at[0]), UInt32::load(from + at[1]), UInt32::load(from + at[2]), UInt32::load(from + at[3])};
        rounds<one_pixel>(block, at, x);
        while (any(x[0] > last || x[1] > last || x[2] > last || x[3] > last)) {
            UInt32 further[4] = {x[0], x[1], x[2], x[3]};
            rounds<one_pixel>(block, at, further);
            for (int j = 0; j < 4; ++j) x[j] = select(x[j] > last, further[j], x[j]);
        }
        for (int j = 0; j < 4; ++j) {
            const UInt32 y = x[j] + number<one_pixel>(block, rotation_, at[j]);
            min(y, y - n).store(to + at[j]);
        }
    }
    std::uint32_t n_, mask_;
    int shift_;
    PixelTable plus_[kPermuteRounds], times_[kPermuteRounds], rotation_;
};

/// One number a sample of a block.
struct BlockArray {
    alignas(64) std::uint32_t of[kBlockSamples];
};

/// x / n and x mod n of a block, for x below 2^21: (x + 1/2) / n is further from an integer than the rounding of the product.
HWY_INLINE void divide(const SampleBlock& block, const std::uint32_t* x, std::uint32_t n, std::uint32_t* quotient, std::uint32_t* remainder) {
    const Float inverse = 1.0f / static_cast<float>(n);
    for (std::size_t i = 0; i < block.count; i += kPack) {
        const UInt32 number = UInt32::load(x + i), q = as_uint(to_int((to_real(as_int(number)) + Float(0.5f)) * inverse));
        q.store(quotient + i);
        (number - q * UInt32(n)).store(remainder + i);
    }
}
inline constexpr std::uint64_t kMostStrataOfPacks = 1u << 21;

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
        return unit_float24(stratum * UInt32(1u << (24 - bits)) + shift_right(jitter, 8 + bits));
    }
};

/// What samplers of kind `set` need of a block: indices modulo spp, and the keys of the jitters.
struct SetBlock : SampleBlock {
    alignas(64) std::uint32_t index_in_set[kBlockSamples];
    SampleKeyArray jitter;
    PixelKeyArray slots;  ///< derive_key(key of the pixel, slot_keys)

    template <class KeyOf>
    HWY_INLINE void read_set(std::span<const SampleId> samples, KeyOf key_of, std::uint64_t slot_keys, std::uint32_t count_in_set) {
        read(samples, key_of);
        derive_sample_keys(keys, jitter);
        derive_pixel_keys(keys, slot_keys, slots);
        const bool modulo = SampleBlock::any >= count_in_set;  // or less
        for (std::size_t i = 0; i < kBlockSamples; ++i) index_in_set[i] = low[i];
        if (modulo)
            for (std::size_t i = 0; i < count; ++i) index_in_set[i] = static_cast<std::uint32_t>(index[i] % count_in_set);
        for (std::size_t i = count; i % kPack != 0; ++i) index_in_set[i] = index_in_set[i - 1];
    }
};

KOKSMA_MATHS_END
