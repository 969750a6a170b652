// The vectorised fill of samplers that pad pairs: every slot visits the same points in an order of its own. No include guard: read anew for
// each instruction set, after fill_packs.h.

#include "index_shuffle.h"

KOKSMA_MATHS_BEGIN

/// @param key_of  from Pixel to Key
/// @param pairs   `visited(index, seed, slot)`: which point a sample has, in packs; `value(point, seed, slot, k)`: its number k of the slot
template <class Sampler, class KeyOf, class Pairs>
HWY_INLINE void fill_padded_pairs(const Sampler& sampler, KeyOf key_of, const Pairs& pairs, std::span<const SampleId> samples, SlotRun run,
                                  float* out, std::size_t stride) {
    SampleBlock block;
    PixelKeyArray orders;
    PixelTable order, seeds[2];
    for (std::size_t begin = 0; begin < samples.size(); begin += kBlockSamples, out += kBlockSamples) {
        const auto part = samples.subspan(begin, std::min(kBlockSamples, samples.size() - begin));
        block.read(part, key_of);
        block.derive_pixel_keys(block.keys, kPaddedOrders, orders);
        for (const Slot& slot : run) {
            float* x_out = out + (slot.dimension - run.front().dimension) * stride;
            if (!shuffles_in_packs(block)) {
                fill_points(sampler, part, slot, x_out, stride);
                continue;
            }
            block.hash_pixels(orders, slot.dimension, order);
            for (std::uint32_t k = 0; k < slot.arity; ++k) block.hash_pixels(block.keys, slot.dimension + k, seeds[k]);
            for (std::size_t i = 0; i < block.count; i += kPack) {
                const UInt32 point = pairs.visited(UInt32::load(block.low + i), block.of_pixel(order, i), slot);
                for (std::uint32_t k = 0; k < slot.arity; ++k)
                    pairs.value(point, block.of_pixel(seeds[k], i), slot, k).store_first(block.lanes(i), x_out + k * stride + i);
            }
        }
    }
}

KOKSMA_MATHS_END
