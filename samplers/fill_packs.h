// What the vectorised fills of samplers share: batches cut into blocks, and the integer functions of koksma/sampling/bits.h for
// packs. No include guard: read anew for each instruction set, after koksma/simd/each_target.h.
//
// A lane is a sample. What depends on a pixel and a dimension is computed once for each pixel of the block, one pixel a lane
// (`per_pixel`), and handed to the samples by a permutation of lanes (`of_pixel`): sixteen samples of one pixel cost what
// samples of sixteen pixels cost, and no pack ends where a pixel does.

#include "fill_points.h"

#include <algorithm>
#include <bit>
#include <cstddef>
#include <span>

KOKSMA_MATHS_BEGIN

inline constexpr std::size_t kPack = kLanes;
/// Samples of a block: what fits into the first-level cache beside a sampler's tables.
inline constexpr std::size_t kBlockSamples = 256;
/// Dimensions whose pixels are hashed before the first of them is drawn: a hash is a long chain of multiplications.
inline constexpr std::uint32_t kAhead = 4;

/// One 32-bit number a pixel of a block; readable a pack beyond the last.
struct PixelTable {
    alignas(64) std::uint32_t of[kBlockSamples + kPack];
};

struct KeyPack {
    UInt32 k0, k1;
};

/// The same bits as koksma::keyed_hash for each lane.
[[nodiscard]] HWY_INLINE UInt32 keyed_hash(KeyPack key, UInt32 counter) {
    UInt32 x = key.k0 + counter * UInt32(0x9e3779b9u);
    x = (x ^ shift_right<16>(x)) * UInt32(0x21f0aaadu);
    x = (x ^ shift_right<15>(x)) + key.k1;
    x = (x ^ shift_right<16>(x)) * UInt32(0x735a2d97u);
    x = (x ^ shift_right<15>(x)) * UInt32(0x21f0aaadu);
    return x ^ shift_right<15>(x);
}

/// One 64-bit key a sample or a pixel, in two words. Arrays of 64-bit numbers are left to plain loops, which compilers vectorise.
template <std::size_t capacity>
struct KeyArray {
    alignas(64) std::uint32_t k0[capacity];
    alignas(64) std::uint32_t k1[capacity];

    HWY_INLINE void set(std::size_t i, Key key) { k0[i] = key.k0, k1[i] = key.k1; }
    [[nodiscard]] HWY_INLINE Key operator[](std::size_t i) const { return {k0[i], k1[i]}; }
    [[nodiscard]] HWY_INLINE KeyPack pack(std::size_t i) const { return {UInt32::load(k0 + i), UInt32::load(k1 + i)}; }
};
using PixelKeyArray = KeyArray<kBlockSamples + kPack>;
using SampleKeyArray = KeyArray<kBlockSamples>;

/// A block of a batch, taken apart.
struct SampleBlock {
    std::size_t count;                ///< samples; arrays are filled up to whole packs with copies of the last
    std::size_t pixels;               ///< stretches of one pixel
    std::uint64_t any, all;           ///< the indices' bits: in any of them, in all
    PixelKeyArray keys;               ///< of the pixels
    std::uint32_t first[kBlockSamples / kPack];     ///< the pixel of a pack's first sample,
    alignas(64) std::uint32_t lane[kBlockSamples];  ///< and how many pixels after it this sample's is: below kLanes
    alignas(64) std::uint32_t low[kBlockSamples];   ///< the low 32 bits of each index,
    alignas(64) std::uint32_t high[kBlockSamples];  ///< and the high ones
    alignas(64) std::uint64_t index[kBlockSamples];

    /// @param key_of  from Pixel to Key
    template <class KeyOf>
    HWY_INLINE void read(std::span<const SampleId> samples, KeyOf key_of) {
        count = samples.size();
        std::uint64_t in_any = 0, in_all = ~std::uint64_t{0};
        for (std::size_t i = 0; i < count; ++i) {
            const std::uint64_t n = samples[i].index;
            index[i] = n;
            low[i] = static_cast<std::uint32_t>(n);
            high[i] = static_cast<std::uint32_t>(n >> 32);
            in_any |= n;
            in_all &= n;
        }
        any = in_any, all = in_all;

        Pixel places[kBlockSamples];
        std::uint32_t last = 0;
        places[0] = samples[0].pixel;
        for (std::size_t i = 0; i < count; ++i) {
            if (samples[i].pixel != places[last]) places[++last] = samples[i].pixel;
            lane[i] = last;
        }
        pixels = last + 1;
        for (std::size_t p = 0; p < pixels; ++p) keys.set(p, key_of(places[p]));

        for (std::size_t i = count; i % kPack != 0; ++i) lane[i] = lane[i - 1], index[i] = index[i - 1], low[i] = low[i - 1], high[i] = high[i - 1];
        for (std::size_t i = 0; i < count; i += kPack) {
            first[i / kPack] = lane[i];
            (UInt32::load(lane + i) - UInt32(lane[i])).store(lane + i);
        }
    }

    /// How many of a pack's lanes are samples.
    [[nodiscard]] HWY_INLINE std::size_t lanes(std::size_t i) const { return count - i; }
    /// What a table has for the pixels of the samples i, i + 1, ..
    [[nodiscard]] HWY_INLINE UInt32 of_pixel(const PixelTable& table, std::size_t i) const { return of_pixel(table.of, i); }
    [[nodiscard]] HWY_INLINE KeyPack of_pixel(const PixelKeyArray& table, std::size_t i) const { return {of_pixel(table.k0, i), of_pixel(table.k1, i)}; }
    [[nodiscard]] HWY_INLINE UInt32 of_pixel(const std::uint32_t* table, std::size_t i) const {
        return lookup(UInt32::load_any(table + first[i / kPack]), UInt32::load(lane + i));
    }
    /// The key of a sample's pixel.
    [[nodiscard]] HWY_INLINE Key key_of(std::size_t i) const { return keys[first[i / kPack] + lane[i]]; }
    /// keyed_hash(key of the pixel, counter) for each pixel.
    HWY_INLINE void hash_pixels(const PixelKeyArray& pixel_keys, std::uint32_t counter, PixelTable& out) const {
        for (std::size_t p = 0; p < pixels; p += kPack) keyed_hash(pixel_keys.pack(p), counter).store(out.of + p);
    }
    /// derive_key(key of the pixel, index) for each sample.
    HWY_INLINE void derive_sample_keys(const PixelKeyArray& pixel_keys, SampleKeyArray& out) const {
        alignas(64) std::uint64_t mixed[kBlockSamples + kPack], derived[kBlockSamples];
        for (std::size_t p = 0; p < pixels; ++p) mixed[p] = mix64(join_key(pixel_keys[p]) ^ 0xd1b54a32d192ed03ull);
        const std::size_t end = (count + kPack - 1) / kPack * kPack;
        for (std::size_t i = 0; i < end; ++i) derived[i] = mixed[first[i / kPack] + lane[i]] ^ index[i];
        for (std::size_t i = 0; i < end; ++i) {
            const std::uint64_t key = mix64(derived[i]);
            out.k0[i] = static_cast<std::uint32_t>(key);
            out.k1[i] = static_cast<std::uint32_t>(key >> 32);
        }
    }
    /// derive_key(key of the pixel, counter) for each pixel.
    HWY_INLINE void derive_pixel_keys(const PixelKeyArray& pixel_keys, std::uint64_t counter, PixelKeyArray& out) const {
        for (std::size_t p = 0; p < pixels; ++p) out.set(p, derive_key(pixel_keys[p], counter));
    }
};

/// The integer k below 2^24 as k * 2^-24.
[[nodiscard]] HWY_INLINE Float unit_float24(UInt32 k) { return to_real(as_int(k)) * Float(0x1p-24f); }
/// The same bits as koksma::unit_float for each lane.
[[nodiscard]] HWY_INLINE Float unit_float(UInt32 x) { return unit_float24(shift_right<8>(x)); }
/// unit_float(reverse_bits(x)).
[[nodiscard]] HWY_INLINE Float unit_float_rev(UInt32 x) { return unit_float24(reverse_bits_24(x)); }

/// The same bits as koksma::owen_hash_rev (owen_hash.h) for each lane.
[[nodiscard]] HWY_INLINE UInt32 owen_hash_rev(UInt32 x, UInt32 seed) {
    x = x ^ x * UInt32(0x3d20adeau);
    x = x + seed;
    x = x * (shift_right<16>(seed) | UInt32(1u));
    x = x ^ x * UInt32(0x05526c56u);
    return x ^ x * UInt32(0x53a22864u);
}

/// A 32-bit binary fraction.
[[nodiscard]] HWY_INLINE Double fraction(UInt32 x) { return Double::of(x) * Double::of(0x1p-32); }

/// The same bits as koksma::stratum_float (stratum.h) for each lane.
[[nodiscard]] HWY_INLINE Float stratum_float(UInt32 stratum, std::uint32_t count, double scale, Double position) {
    UInt32 k = as_uint(((Double::of(as_int(stratum)) + position) * Double::of(scale)).truncated());
    // k * count - (stratum << 24) is small, so 32 bits are enough to compare.
    Int32 above = as_int(k * UInt32(count) - shift_left<24>(stratum));
    const Mask low = above < Int32(0);
    k = k + select(low, UInt32(1u), UInt32(0u));
    above = above + select(low, Int32(static_cast<std::int32_t>(count)), Int32(0));
    return unit_float24(k - select(above > Int32((1 << 24) - 1), UInt32(1u), UInt32(0u)));
}

/// table[i] of each lane, i below n, from a few tables in registers; the table is readable to a multiple of kLanes.
[[nodiscard]] HWY_INLINE UInt32 small_lookup(const std::uint16_t* table, std::uint32_t n, UInt32 i) {
    const UInt32 place = i & UInt32(kLanes - 1);
    UInt32 x = lookup(load_widened(table), place);
    for (std::uint32_t first = kLanes; first < n; first += kLanes) x = select(i > UInt32(first - 1), lookup(load_widened(table + first), place), x);
    return x;
}

/// table[i] of each lane, i below 16; the table is linear over xor, and table[0] is 0.
[[nodiscard]] HWY_INLINE UInt32 linear_lookup(const std::uint32_t* table, UInt32 i) {
    if constexpr (kLanes == 16) return lookup(UInt32::load_any(table), i);
    // The lower bits of i in one lookup, each other bit by itself.
    UInt32 x = lookup(UInt32::load_any(table), i & UInt32(kLanes - 1));
    for (std::uint32_t bit = kLanes; bit < 16; bit *= 2) x = x ^ select((i & UInt32(bit)) == UInt32(bit), UInt32(table[bit]), UInt32(0u));
    return x;
}

/// The same bits as koksma::shuffled_index (index_shuffle.h) for each lane, indices below 2^32.
/// @param seed  keyed_hash of the pixel's key for orders
[[nodiscard]] HWY_INLINE UInt32 shuffled_index(UInt32 index, UInt32 seed) { return reverse_bits(owen_hash_rev(reverse_bits(index), seed)); }
[[nodiscard]] HWY_INLINE bool shuffles_in_packs(const SampleBlock& block) { return block.any >> 32 == 0; }

/// The same bits as koksma::pascal_rev (sobol_pair.h) for each lane, indices below 2^32.
[[nodiscard]] HWY_INLINE UInt32 pascal_rev(UInt32 index) {
    index = index ^ (shift_right<1>(index) & UInt32(0x55555555u));
    index = index ^ (shift_right<2>(index) & UInt32(0x33333333u));
    index = index ^ (shift_right<4>(index) & UInt32(0x0f0f0f0fu));
    index = index ^ (shift_right<8>(index) & UInt32(0x00ff00ffu));
    return index ^ shift_right<16>(index);
}

KOKSMA_MATHS_END
