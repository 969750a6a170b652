#include "sobol.h"

#include <algorithm>
#include <bit>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "sobol_fill.cpp"
#include <koksma/simd/each_target.h>

#include "fill_packs.h"

KOKSMA_MATHS_BEGIN

/// As koksma::owen_tree.
HWY_INLINE UInt32 tree_scrambled(UInt32 x, KeyPack key) {
    UInt32 y = (x ^ keyed_hash(key, UInt32(1u))) & UInt32(0x80000000u);
    for (int depth = 1; depth < 32; ++depth) {
        const UInt32 node = shift_right(x, 32 - depth) | UInt32(1u << depth);
        const UInt32 bit = (shift_right(x, 31 - depth) ^ shift_right<31>(keyed_hash(key, node))) & UInt32(1u);
        y = y | bit * UInt32(1u << (31 - depth));
    }
    return y;
}

/// One dimension of a block. Index digits above `nibbles` are the same for all samples; they contribute `fixed_rev`.
struct SobolRow {
    const SobolNibble* matrix;
    std::uint32_t dimension, fixed_rev;
    int nibbles;
};

/// @param keys      of the pixels: a hash or, for owen_tree, the key
/// @tparam nibbles  row.nibbles, or 0 for any number of them
template <SobolSampler::Randomize randomize, int nibbles>
HWY_INLINE void fill_row(const SampleBlock& block, const SobolRow& row, const PixelTable (&keys)[2], float* out) {
    using enum SobolSampler::Randomize;
    for (std::size_t i = 0; i < block.count; i += kPack) {
        UInt32 x = row.fixed_rev, digits = UInt32::load(block.low + i);
        for (int k = 0; k < (nibbles > 0 ? nibbles : row.nibbles); ++k) {
            if (k == 8) digits = UInt32::load(block.high + i);
            x = x ^ linear_lookup(row.matrix[k].entry_rev.data(), digits & UInt32(15u));
            digits = shift_right<4>(digits);
        }
        if constexpr (randomize == digital_shift) x = x ^ block.of_pixel(keys[0], i);
        if constexpr (randomize == owen) x = owen_hash_rev(x, block.of_pixel(keys[0], i));
        if constexpr (randomize == owen_tree) x = reverse_bits(tree_scrambled(reverse_bits(x), {block.of_pixel(keys[0], i), block.of_pixel(keys[1], i)}));
        unit_float_rev(x).store_first(block.lanes(i), out + i);
    }
}

template <SobolSampler::Randomize randomize>
HWY_INLINE void hash_pixels(const SampleBlock& block, std::uint32_t dimension, PixelTable (&keys)[2]) {
    using enum SobolSampler::Randomize;
    if constexpr (randomize == digital_shift || randomize == owen) block.hash_pixels(block.keys, dimension, keys[0]);
    if constexpr (randomize == owen_tree)
        for (std::size_t p = 0; p < block.pixels; ++p) {
            const Key key = derive_key(block.keys[p], dimension);
            keys[0].of[p] = key.k0, keys[1].of[p] = key.k1;
        }
}

template <SobolSampler::Randomize randomize>
void fill_rows(const SobolNibble* matrices, const PixelKeys& keys, std::span<const SampleId> samples, SlotRun run, float* out, std::size_t stride) {
    const std::uint32_t first = run.front().dimension, end = first + dimension_count(run);
    SampleBlock block;
    PixelTable ahead[kAhead][2];
    for (std::size_t begin = 0; begin < samples.size(); begin += kBlockSamples, out += kBlockSamples) {
        block.read(samples.subspan(begin, std::min(kBlockSamples, samples.size() - begin)), keys);
        const int nibbles = (static_cast<int>(std::bit_width(block.any ^ block.all)) + 3) / 4;
        const std::uint64_t fixed = nibbles == 16 ? 0 : block.all >> (4 * nibbles) << (4 * nibbles);
        for (std::uint32_t d = first; d < end; ++d) {
            if ((d - first) % kAhead == 0)
                for (std::uint32_t k = 0; k < std::min(kAhead, end - d); ++k) hash_pixels<randomize>(block, d + k, ahead[k]);
            const SobolRow row{matrices + std::size_t{d} * kSobolNibbles, d, sobol_rev(matrices, fixed, d), nibbles};
            const auto& hash = ahead[(d - first) % kAhead];
            float* to = out + (d - first) * stride;
            if (nibbles == 2)  // 17 to 256 samples a pixel
                fill_row<randomize, 2>(block, row, hash, to);
            else
                fill_row<randomize, 0>(block, row, hash, to);
        }
    }
}

void fill_sobol(SobolSampler::Randomize randomize, const SobolNibble* matrices, const PixelKeys& keys, std::span<const SampleId> samples, SlotRun run,
                float* out, std::size_t stride) {
    using enum SobolSampler::Randomize;
    switch (randomize) {
        case none: return fill_rows<none>(matrices, keys, samples, run, out, stride);
        case digital_shift: return fill_rows<digital_shift>(matrices, keys, samples, run, out, stride);
        case owen: return fill_rows<owen>(matrices, keys, samples, run, out, stride);
        case owen_tree: return fill_rows<owen_tree>(matrices, keys, samples, run, out, stride);
    }
}

KOKSMA_MATHS_END

#if HWY_ONCE
namespace koksma {
HWY_EXPORT(fill_sobol);
void SobolSampler::fill(std::span<const SampleId> samples, SlotRun run, float* out, std::size_t stride) const noexcept {
    if (!run.empty()) HWY_DYNAMIC_DISPATCH(fill_sobol)(randomize_, matrices_, keys_, samples, run, out, stride);
}
}  // namespace koksma
#endif
