#include "sobol_padded.h"

#include <algorithm>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "sobol_padded_fill.cpp"
#include <koksma/simd/each_target.h>

#include "fill_packs.h"

KOKSMA_MATHS_BEGIN

void fill_sobol_padded(const SobolPaddedSampler& sampler, const PixelKeys& keys, std::span<const SampleId> samples, SlotRun run, float* out,
                       std::size_t stride) {
    SampleBlock block;
    PixelKeyArray orders;
    PixelTable order, seeds[2];
    for (std::size_t begin = 0; begin < samples.size(); begin += kBlockSamples, out += kBlockSamples) {
        const auto part = samples.subspan(begin, std::min(kBlockSamples, samples.size() - begin));
        block.read(part, keys);
        block.derive_pixel_keys(block.keys, kPaddedOrders, orders);
        for (const Slot& slot : run) {
            const std::uint32_t d = slot.dimension;
            float* x_out = out + (d - run.front().dimension) * stride;
            if (!shuffles_in_packs(block)) {
                fill_points(sampler, part, slot, x_out, stride);
                continue;
            }
            block.hash_pixels(orders, d, order);
            block.hash_pixels(block.keys, d, seeds[0]);
            block.hash_pixels(block.keys, d + 1, seeds[1]);
            for (std::size_t i = 0; i < block.count; i += kPack) {
                const UInt32 x_rev = shuffled_index(UInt32::load(block.low + i), block.of_pixel(order, i));
                unit_float_rev(owen_hash_rev(x_rev, block.of_pixel(seeds[0], i))).store_first(block.lanes(i), x_out + i);
                if (slot.arity == 2)
                    unit_float_rev(owen_hash_rev(pascal_rev(x_rev), block.of_pixel(seeds[1], i))).store_first(block.lanes(i), x_out + stride + i);
            }
        }
    }
}

KOKSMA_MATHS_END

#if HWY_ONCE
namespace koksma {
HWY_EXPORT(fill_sobol_padded);
void SobolPaddedSampler::fill(std::span<const SampleId> samples, SlotRun run, float* out, std::size_t stride) const noexcept {
    HWY_DYNAMIC_DISPATCH(fill_sobol_padded)(*this, keys_, samples, run, out, stride);
}
}  // namespace koksma
#endif
