#include "halton.h"

#include "stratum.h"

#include <algorithm>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "halton_fill.cpp"
#include <koksma/simd/each_target.h>

#include "fill_packs.h"

KOKSMA_MATHS_BEGIN

using Randomize = HaltonSampler::Randomize;

/// One dimension of a block. All indices have at most `places` digits; their digits are taken from floats, exactly.
struct HaltonRow {
    const HaltonBase* base;
    std::uint32_t places;
    std::uint32_t power;  ///< base^places, at most 2^24
};
inline constexpr std::uint64_t kLargestIndex = (1u << 21) - 1;

/// n / base, for integers below 2^21: (n + 1/2) / base is at least 1 / (2 base) from an integer, more than the rounding of the product.
HWY_INLINE Float quotient(Float n, Float inverse_base) { return floor((n + Float(0.5f)) * inverse_base); }

/// The integer nearest to x, for x in [0, 2^22]: the last bits of x + 2^23.
HWY_INLINE UInt32 nearest(Float x) { return as_uint(bits_of(x + Float(0x1p23f))) & UInt32(0x7fffffu); }
/// x or x + n, for an x in [-n, n) that wrapped.
HWY_INLINE UInt32 not_negative(UInt32 x, UInt32 n) { return min(x, x + n); }
/// x or x - n, for x below 2 n.
HWY_INLINE UInt32 wrapped(UInt32 x, UInt32 n) { return min(x, x - n); }

/// Digits of numerator / denominator, leading first.
struct Division {
    Float scale;  ///< 2^bits / denominator
    UInt32 denominator, rest;
    /// The next `bits` digits, at most 16.
    template <int bits>
    HWY_INLINE UInt32 next() {
        // The product is off by less than 2^-7: rounded, it gives the digits or one more.
        const UInt32 k = nearest(to_real(as_int(rest)) * scale);
        rest = shift_left<bits>(rest) - k * denominator;  // between -denominator and denominator: 32 bits are enough
        const Mask more = rest > UInt32(0x7fffffffu);
        rest = not_negative(rest, denominator);
        return k - select(more, UInt32(1u), UInt32(0u));
    }
};

/// none, cp: the radical inverse, without the randomisation by a hash of the block's pixels.
template <bool shifted>
HWY_INLINE void fill_inverse(const SampleBlock& block, const HaltonRow& row, const PixelTable& hash, float* out) {
    const Float base = static_cast<float>(row.base->base), inverse = 1.0f / static_cast<float>(row.base->base);
    const UInt32 power = row.power;
    const Float scale = (shifted ? 0x1p16f : 0x1p12f) / static_cast<float>(row.power);
    for (std::size_t i = 0; i < block.count; i += kPack) {
        Float n = to_real(as_int(UInt32::load(block.low + i))), mirrored = 0.0f;
        for (std::uint32_t place = 1; place < row.places; ++place) {
            const Float q = quotient(n, inverse);
            mirrored = mirrored * base + (n - q * base);
            n = q;
        }
        Division division{scale, power, as_uint(to_int(mirrored * base + n))};
        if constexpr (shifted) {
            const UInt32 high = division.next<16>();
            unit_float((shift_left<16>(high) | division.next<16>()) + block.of_pixel(hash, i)).store_first(block.lanes(i), out + i);
        } else {
            const UInt32 high = division.next<12>();
            const UInt32 floor = shift_left<12>(high) | division.next<12>();
            const UInt32 ceil = floor + select(division.rest == UInt32(0u), UInt32(0u), UInt32(1u));
            unit_float24(min(ceil, UInt32(0xffffffu))).store_first(block.lanes(i), out + i);
        }
    }
}

/// The permutations of one place: permuted_digit (halton.h), taken apart.
struct Permutation {
    UInt32 zero, a, c, inverse_c;
};
HWY_INLINE UInt32 reciprocal(const HaltonBase& b, UInt32 x) {
    return b.base > 4 * kPack ? gather_two(b.inverse, x) & UInt32(0xffffu) : small_lookup(b.inverse, b.base, x);
}
HWY_INLINE Permutation permutation(const HaltonBase& b, UInt32 zeros, UInt32 weight, UInt32 hash) {
    const UInt32 base = b.base, less = b.base - 1;
    const UInt32 c = product_high(hash * less, base);
    return {product_high(zeros * weight, base), product_high(hash, less) + UInt32(1u), c, reciprocal(b, c)};
}
HWY_INLINE UInt32 image(const HaltonBase& b, UInt32 digit, const Permutation& p) {
    const UInt32 base = b.base;
    const UInt32 difference = wrapped(reciprocal(b, wrapped(digit + p.c, base)) + base - p.inverse_c, base);
    const UInt32 y = p.a * difference + p.zero;
    const UInt32 q = nearest(to_real(as_int(y)) * Float(1.0f / static_cast<float>(b.base)));  // or one more; y is below 2^26
    return not_negative(y - q * base, base);
}

/// What depends on a pixel and a dimension, for the pixels of a block.
struct HaltonPixels {
    PixelKeyArray keys;
    PixelTable hash;  ///< of none of the digits: the shift, or the images of zeros
    PixelTable zero, a, c, inverse_c;  ///< the permutations of a place

    HWY_INLINE void set_permutations(const SampleBlock& block, const HaltonBase& b, std::uint32_t place, std::uint32_t weight) {
        for (std::size_t p = 0; p < block.pixels; p += kPack) {
            const Permutation f = permutation(b, UInt32::load(hash.of + p), UInt32(weight), keyed_hash(keys.pack(p), UInt32(place << 24)));
            f.zero.store(zero.of + p), f.a.store(a.of + p), f.c.store(c.of + p), f.inverse_c.store(inverse_c.of + p);
        }
    }
    [[nodiscard]] HWY_INLINE Permutation permutations(const SampleBlock& block, std::size_t i) const {
        return {block.of_pixel(zero, i), block.of_pixel(a, i), block.of_pixel(c, i), block.of_pixel(inverse_c, i)};
    }
};

/// What samples keep between two places.
struct HaltonSamples {
    alignas(64) float rest[kBlockSamples];           ///< the digits of the index that are still to come
    alignas(64) std::uint32_t cells[kBlockSamples];  ///< the images of those before
};

template <bool nested>
HWY_INLINE void fill_scrambled(const SampleBlock& block, const HaltonRow& row, HaltonPixels& pixels, HaltonSamples& samples, float* out) {
    const HaltonBase& b = *row.base;
    const UInt32 base = b.base;
    const Float inverse = 1.0f / static_cast<float>(b.base);
    std::uint32_t weight = 1;
    for (std::uint32_t place = 0; place < row.places; ++place, weight *= b.base) {
        const bool last = place + 1 == row.places;
        if (place != 0 && !nested) pixels.set_permutations(block, b, place, weight);
        for (std::size_t i = 0; i < block.count; i += kPack) {
            const UInt32 low = UInt32::load(block.low + i);
            const Float n = place == 0 ? to_real(as_int(low)) : Float::load(samples.rest + i);
            const Float q = last ? Float(0.0f) : quotient(n, inverse);
            const UInt32 digit = nearest(n - q * Float(static_cast<float>(b.base)));
            UInt32 y;
            if (place == 0 || !nested) {
                y = image(b, digit, pixels.permutations(block, i));
            } else {
                const KeyPack key = block.of_pixel(pixels.keys, i);
                const UInt32 before = low - nearest(n) * UInt32(weight);
                y = image(b, digit, permutation(b, keyed_hash(key, UInt32(kZeroImages) | before), UInt32(weight), keyed_hash(key, UInt32(place << 24) | before)));
            }
            if (place != 0) y = y + UInt32::load(samples.cells + i) * base;
            y.store(samples.cells + i);
            q.store(samples.rest + i);
        }
    }

    const std::uint32_t count = static_cast<std::uint32_t>(b.cells);
    const UInt32 places = row.power, left = count / row.power, cells = count;
    for (std::size_t i = 0; i < block.count; i += kPack) {
        UInt32 zeros;
        if constexpr (nested)
            zeros = keyed_hash(block.of_pixel(pixels.keys, i), UInt32(kZeroImages) | UInt32::load(block.low + i));
        else
            zeros = block.of_pixel(pixels.hash, i);
        const UInt32 cell = UInt32::load(samples.cells + i) * left + product_high(zeros * places, left);
        stratum_float(cell, count, b.scale, fraction(zeros * cells)).store_first(block.lanes(i), out + i);
    }
}

/// Base 2: digits are bits.
HWY_INLINE void fill_base_2(const SampleBlock& block, Randomize randomize, const PixelTable& hash, float* out) {
    for (std::size_t i = 0; i < block.count; i += kPack) {
        const UInt32 index = UInt32::load(block.low + i);
        Float x;
        switch (randomize) {
            case Randomize::none: x = unit_float_rev(index); break;
            case Randomize::shift: x = unit_float(reverse_bits(index) + block.of_pixel(hash, i)); break;
            case Randomize::digits: x = unit_float(reverse_bits(index) ^ block.of_pixel(hash, i)); break;
            default: x = unit_float_rev(owen_hash_rev(index, block.of_pixel(hash, i)));
        }
        x.store_first(block.lanes(i), out + i);
    }
}

bool is_scrambled(Randomize randomize) { return randomize == Randomize::digits || randomize == Randomize::owen; }

void prepare(const SampleBlock& block, const HaltonBase* bases, std::uint32_t dimension, Randomize randomize, const PixelKeyArray& digit_keys,
             HaltonPixels& pixels) {
    if (randomize == Randomize::none) return;
    if (dimension == 0 || !is_scrambled(randomize)) return block.hash_pixels(block.keys, dimension, pixels.hash);
    for (std::size_t p = 0; p < block.pixels; ++p) pixels.keys.set(p, split_key(mix64(join_key(digit_keys[p]) ^ dimension)));
    block.hash_pixels(pixels.keys, kZeroImages, pixels.hash);
    pixels.set_permutations(block, bases[dimension], 0, 1);
}

void fill_row(const SampleBlock& block, const HaltonBase* bases, std::uint32_t dimension, Randomize randomize, HaltonPixels& pixels, HaltonSamples& samples,
              float* out) {
    if (dimension == 0) return fill_base_2(block, randomize, pixels.hash, out);
    HaltonRow row{.base = bases + dimension, .places = 1, .power = bases[dimension].base};
    const std::uint64_t largest = block.any;  // or more
    for (; row.power <= largest && row.power < (1u << 24); ++row.places) row.power *= row.base->base;
    if (largest > kLargestIndex || row.power > (is_scrambled(randomize) ? row.base->cells : 1u << 24)) {
        const Slot slot{.dimension = dimension};
        for (std::size_t i = 0; i < block.count; ++i) out[i] = HaltonSampler::Point(bases, block.key_of(i), block.index[i], randomize).get_1d(slot);
        return;
    }
    switch (randomize) {
        case Randomize::none: return fill_inverse<false>(block, row, pixels.hash, out);
        case Randomize::shift: return fill_inverse<true>(block, row, pixels.hash, out);
        case Randomize::digits: return fill_scrambled<false>(block, row, pixels, samples, out);
        case Randomize::owen: return fill_scrambled<true>(block, row, pixels, samples, out);
    }
}

void fill_halton(const HaltonBase* bases, Randomize randomize, const PixelKeys& keys, std::span<const SampleId> samples, SlotRun run, float* out,
                 std::size_t stride) {
    const std::uint32_t first = run.front().dimension, end = first + dimension_count(run);
    SampleBlock block;
    PixelKeyArray digit_keys;
    HaltonPixels ahead[kAhead];
    HaltonSamples kept;
    for (std::size_t begin = 0; begin < samples.size(); begin += kBlockSamples, out += kBlockSamples) {
        block.read(samples.subspan(begin, std::min(kBlockSamples, samples.size() - begin)), keys);
        block.derive_pixel_keys(block.keys, kHaltonDigits, digit_keys);
        for (std::uint32_t d = first; d < end; ++d) {
            if ((d - first) % kAhead == 0)
                for (std::uint32_t k = 0; k < std::min(kAhead, end - d); ++k) prepare(block, bases, d + k, randomize, digit_keys, ahead[k]);
            fill_row(block, bases, d, randomize, ahead[(d - first) % kAhead], kept, out + (d - first) * stride);
        }
    }
}

KOKSMA_MATHS_END

#if HWY_ONCE
namespace koksma {
HWY_EXPORT(fill_halton);
void HaltonSampler::fill(std::span<const SampleId> samples, SlotRun run, float* out, std::size_t stride) const noexcept {
    if (!run.empty()) HWY_DYNAMIC_DISPATCH(fill_halton)(bases_, randomize_, keys_, samples, run, out, stride);
}
}  // namespace koksma
#endif
