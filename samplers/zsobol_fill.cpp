#include "zsobol.h"

#include <algorithm>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "zsobol_fill.cpp"
#include <koksma/simd/each_target.h>

#include "fill_packs.h"

KOKSMA_MATHS_BEGIN

/// kDigitPermutations, readable to whole packs.
inline constexpr auto kPermutationTable = [] {
    std::array<std::uint16_t, 32> table{};
    for (std::size_t i = 0; i < kDigitPermutations.size(); ++i) table[i] = kDigitPermutations[i];
    return table;
}();

/// The orders of one slot: permute_digits4, first for the digits of the pixels, then for those of the samples.
struct ZOrder {
    PixelTable x_rev, y_rev;  ///< what the digits of the pixel contribute to the point
    std::uint64_t above_pixel[kBlockSamples];
    alignas(64) std::uint64_t above[kBlockSamples];
    alignas(64) std::uint32_t choice[kBlockSamples];
    alignas(64) std::uint32_t images[kBlockSamples];  ///< of the digits of the sample

    /// The keys of the block are the places of its pixels along the curve.
    HWY_INLINE void set(const SampleBlock& block, int sample_bits, int bits, std::uint64_t key) {
        for (std::size_t p = 0; p < block.pixels; ++p) {
            const std::uint64_t place = join_key(block.keys[p]);
            PermutedDigits digits;
            for (int shift = bits - sample_bits; shift > 0;) {
                shift -= 2;
                digits.add(static_cast<unsigned>(place >> shift) & 3u, key);
            }
            const std::uint64_t first = digits.images << sample_bits;
            x_rev.of[p] = static_cast<std::uint32_t>(first);
            y_rev.of[p] = static_cast<std::uint32_t>(koksma::pascal_rev(first));
            above_pixel[p] = digits.above;
        }
        const std::size_t end = (block.count + kPack - 1) / kPack * kPack;
        for (std::size_t i = 0; i < end; ++i) above[i] = above_pixel[block.first[i / kPack] + block.lane[i]];
        for (std::size_t i = 0; i < end; ++i) images[i] = 0;
        int shift = sample_bits;
        while (shift >= 2) {
            shift -= 2;
            for (std::size_t i = 0; i < end; ++i) choice[i] = chosen_permutation(mix64(key ^ above[i]));
            for (std::size_t i = 0; i < end; ++i) above[i] = (above[i] << 2) | ((block.low[i] >> shift) & 3u);
            for (std::size_t i = 0; i < end; i += kPack) {
                const UInt32 digit = shift_right(UInt32::load(block.low + i), shift) & UInt32(3u);
                const UInt32 permutation = small_lookup(kPermutationTable.data(), kDigitPermutations.size(), UInt32::load(choice + i));
                (shift_left<2>(UInt32::load(images + i)) | (shift_right(permutation, digit + digit) & UInt32(3u))).store(images + i);
            }
        }
        if (shift == 1)
            for (std::size_t i = 0; i < end; ++i) images[i] = (images[i] << 1) | ((block.low[i] ^ static_cast<std::uint32_t>(mix64(key ^ above[i]) >> 63)) & 1u);
    }
};

void fill_zsobol(int sample_bits, int bits, Key order_key, Key value_key, bool owen, std::span<const SampleId> samples, SlotRun run, float* out,
                 std::size_t stride) {
    const auto place_as_key = [](Pixel pixel) { return split_key(place_of(pixel)); };
    SampleBlock block;
    ZOrder order;
    for (std::size_t begin = 0; begin < samples.size(); begin += kBlockSamples, out += kBlockSamples) {
        block.read(samples.subspan(begin, std::min(kBlockSamples, samples.size() - begin)), place_as_key);
        for (const Slot& slot : run) {
            float* row = out + (slot.dimension - run.front().dimension) * stride;
            order.set(block, sample_bits, bits, join_key(derive_key(order_key, slot.dimension)));
            for (std::uint32_t k = 0; k < slot.arity; ++k, row += stride) {
                const UInt32 hash = koksma::keyed_hash(value_key, slot.dimension + k);
                for (std::size_t i = 0; i < block.count; i += kPack) {
                    const UInt32 images = UInt32::load(order.images + i);
                    const UInt32 x = k == 0 ? images ^ block.of_pixel(order.x_rev, i) : pascal_rev(images) ^ block.of_pixel(order.y_rev, i);
                    unit_float_rev(owen ? owen_hash_rev(x, hash) : x ^ hash).store_first(block.lanes(i), row + i);
                }
            }
        }
    }
}

KOKSMA_MATHS_END

#if HWY_ONCE
namespace koksma {
HWY_EXPORT(fill_zsobol);
void ZSobolSampler::fill(std::span<const SampleId> samples, SlotRun run, float* out, std::size_t stride) const noexcept {
    HWY_DYNAMIC_DISPATCH(fill_zsobol)(sample_bits_, bits_, order_key_, value_key_, owen_, samples, run, out, stride);
}
}  // namespace koksma
#endif
