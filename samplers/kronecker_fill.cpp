#include "kronecker.h"

#include <algorithm>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "kronecker_fill.cpp"
#include <koksma/simd/each_target.h>

#include "fill_packs.h"

KOKSMA_MATHS_BEGIN

/// The same bits as koksma::kronecker_bits for each lane, indices below 2^32.
HWY_INLINE UInt32 multiple(UInt32 index, std::uint64_t step) {
    const UInt32 low = static_cast<std::uint32_t>(step), high = static_cast<std::uint32_t>(step >> 32);
    return product_high(index, low) + index * high + UInt32(0x80000000u);
}

void fill_kronecker(const KroneckerSampler& sampler, const PixelKeys& keys, bool randomized, std::span<const SampleId> samples, SlotRun run, float* out,
                    std::size_t stride) {
    const auto key_of = [&](Pixel pixel) { return randomized ? keys(pixel) : Key{}; };
    SampleBlock block;
    PixelKeyArray orders;
    PixelTable order, shifts[2];
    for (std::size_t begin = 0; begin < samples.size(); begin += kBlockSamples, out += kBlockSamples) {
        const auto part = samples.subspan(begin, std::min(kBlockSamples, samples.size() - begin));
        block.read(part, key_of);
        block.derive_pixel_keys(block.keys, kPaddedOrders, orders);
        for (const Slot& slot : run) {
            const std::uint32_t d = slot.dimension;
            float* x_out = out + (d - run.front().dimension) * stride;
            if (!shuffles_in_packs(block)) {
                fill_points(sampler, part, slot, x_out, stride);
                continue;
            }
            block.hash_pixels(orders, d, order);
            block.hash_pixels(block.keys, d, shifts[0]);
            block.hash_pixels(block.keys, d + 1, shifts[1]);
            for (std::size_t i = 0; i < block.count; i += kPack) {
                UInt32 index = UInt32::load(block.low + i);
                if (randomized || d != 0) index = shuffled_index(index, block.of_pixel(order, i));
                for (std::uint32_t k = 0; k < slot.arity; ++k) {
                    UInt32 x = multiple(index, slot.arity == 1 ? kR1 : k == 0 ? kR2x : kR2y);
                    if (randomized) x = x + block.of_pixel(shifts[k], i);
                    unit_float(x).store_first(block.lanes(i), x_out + k * stride + i);
                }
            }
        }
    }
}

KOKSMA_MATHS_END

#if HWY_ONCE
namespace koksma {
HWY_EXPORT(fill_kronecker);
void KroneckerSampler::fill(std::span<const SampleId> samples, SlotRun run, float* out, std::size_t stride) const noexcept {
    HWY_DYNAMIC_DISPATCH(fill_kronecker)(*this, keys_, randomized_, samples, run, out, stride);
}
}  // namespace koksma
#endif
