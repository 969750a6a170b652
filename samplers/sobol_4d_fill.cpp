#include "sobol_4d.h"

#include <algorithm>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "sobol_4d_fill.cpp"
#include <koksma/simd/each_target.h>

#include "fill_packs.h"

KOKSMA_MATHS_BEGIN

/// Coordinate of a point, unscrambled and bit-reversed, for indices below 2^32.
HWY_INLINE UInt32 coordinate_rev(UInt32 index, std::uint32_t dimension) {
    if (dimension == 0) return index;
    if (dimension == 1) return pascal_rev(index);
    UInt32 x = 0u;
    for (std::size_t nibble = 0; nibble < 8; ++nibble, index = shift_right<4>(index))
        x = x ^ linear_lookup(kSobol4[dimension][nibble].data(), index & UInt32(15u));
    return x;
}

void fill_sobol_4d(const Sobol4DSampler& sampler, const PixelKeys& keys, const JointPlace* places, std::span<const SampleId> samples, SlotRun run,
                   float* out, std::size_t stride) {
    SampleBlock block;
    PixelKeyArray orders;
    PixelTable order, seeds;
    for (std::size_t begin = 0; begin < samples.size(); begin += kBlockSamples, out += kBlockSamples) {
        const auto part = samples.subspan(begin, std::min(kBlockSamples, samples.size() - begin));
        block.read(part, keys);
        block.derive_pixel_keys(block.keys, kPaddedOrders, orders);
        for (const Slot& slot : run) {
            float* row = out + (slot.dimension - run.front().dimension) * stride;
            if (!shuffles_in_packs(block)) {
                fill_points(sampler, part, slot, row, stride);
                continue;
            }
            block.hash_pixels(orders, places[slot.dimension].set, order);
            for (std::uint32_t k = 0; k < slot.arity; ++k, row += stride) {
                block.hash_pixels(block.keys, slot.dimension + k, seeds);
                for (std::size_t i = 0; i < block.count; i += kPack) {
                    const UInt32 index = shuffled_index(UInt32::load(block.low + i), block.of_pixel(order, i));
                    const UInt32 x = coordinate_rev(index, places[slot.dimension].within + k);
                    unit_float_rev(owen_hash_rev(x, block.of_pixel(seeds, i))).store_first(block.lanes(i), row + i);
                }
            }
        }
    }
}

KOKSMA_MATHS_END

#if HWY_ONCE
namespace koksma {
HWY_EXPORT(fill_sobol_4d);
void Sobol4DSampler::fill(std::span<const SampleId> samples, SlotRun run, float* out, std::size_t stride) const noexcept {
    HWY_DYNAMIC_DISPATCH(fill_sobol_4d)(*this, keys_, places_.data(), samples, run, out, stride);
}
}  // namespace koksma
#endif
