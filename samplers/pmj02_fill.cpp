#include "pmj02.h"

#include <algorithm>
#include <bit>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "pmj02_fill.cpp"
#include <koksma/simd/each_target.h>

#include "fill_packs.h"

KOKSMA_MATHS_BEGIN

using Randomize = Pmj02Sampler::Randomize;

void fill_pmj02(const PixelKeys& keys, Randomize randomize, std::span<const SampleId> samples, SlotRun run, float* out, std::size_t stride) {
    const auto key_of = [&](Pixel pixel) { return randomize == Randomize::none ? Key{} : keys(pixel); };
    SampleBlock block;
    SampleKeyArray fine;
    PixelKeyArray orders, order_tables;
    PixelTable order, table, hashes[2];
    alignas(64) std::uint32_t leading[kBlockSamples];
    for (std::size_t begin = 0; begin < samples.size(); begin += kBlockSamples, out += kBlockSamples) {
        block.read(samples.subspan(begin, std::min(kBlockSamples, samples.size() - begin)), key_of);
        block.derive_sample_keys(block.keys, fine);
        block.derive_pixel_keys(block.keys, kPmjOrders, orders);
        block.derive_pixel_keys(orders, 1, order_tables);
        for (std::size_t i = 0; i < kBlockSamples; ++i) block.low[i] %= kPmjPoints, leading[i] = std::bit_floor(block.low[i]);
        for (const Slot& slot : run) {
            const std::uint32_t d = slot.dimension;
            float* x_out = out + (d - run.front().dimension) * stride;
            block.hash_pixels(orders, d, order);
            block.hash_pixels(order_tables, d, table);
            block.hash_pixels(block.keys, d, hashes[0]);
            block.hash_pixels(block.keys, d + 1, hashes[1]);
            for (std::size_t i = 0; i < block.count; i += kPack) {
                const UInt32 index = UInt32::load(block.low + i), first = UInt32::load(leading + i);
                UInt32 entry = index;
                if (randomize != Randomize::none || d != 0) {
                    const UInt32 below = first - select(first == UInt32(0u), UInt32(0u), UInt32(1u));
                    entry = shift_right<32 - 3>(block.of_pixel(table, i)) * UInt32(kPmjPoints) + (first | (shuffled_index(index, block.of_pixel(order, i)) & below));
                }
                static_assert(kPmjTables == 8);
                const UInt32 xy = gather_two(pmj_tables(), entry + entry);  // y above x
                for (std::uint32_t k = 0; k < slot.arity; ++k) {
                    UInt32 x = k == 0 ? shift_left<16>(xy) : xy & UInt32(0xffff0000u);
                    if (randomize != Randomize::none) x = x | shift_right<16>(keyed_hash(fine.pack(i), d + k));
                    const UInt32 hash = block.of_pixel(hashes[k], i);
                    switch (randomize) {
                        case Randomize::none: break;
                        case Randomize::shift: x = x + hash; break;
                        case Randomize::digital_shift: x = x ^ hash; break;
                        case Randomize::owen: x = reverse_bits(owen_hash_rev(reverse_bits(x), hash)); break;
                    }
                    unit_float(x).store_first(block.lanes(i), x_out + k * stride + i);
                }
            }
        }
    }
}

KOKSMA_MATHS_END

#if HWY_ONCE
namespace koksma {
HWY_EXPORT(fill_pmj02);
void Pmj02Sampler::fill(std::span<const SampleId> samples, SlotRun run, float* out, std::size_t stride) const noexcept {
    HWY_DYNAMIC_DISPATCH(fill_pmj02)(keys_, randomize_, samples, run, out, stride);
}
}  // namespace koksma
#endif
