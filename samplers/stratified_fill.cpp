#include "stratified.h"

#include <algorithm>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "stratified_fill.cpp"
#include <koksma/simd/each_target.h>

#include "fill_packs.h"
#include "permutation_packs.h"

KOKSMA_MATHS_BEGIN

void fill_stratified(const StratifiedSampler& sampler, const PixelKeys& keys, std::uint64_t slot_keys, const StratifiedGrid& grid, std::uint64_t spp,
                     std::span<const SampleId> samples, SlotRun run, float* out, std::size_t stride) {
    const auto n = static_cast<std::uint32_t>(spp);
    const StrataPack strata(n), columns(grid.multi_jittered ? grid.columns * grid.rows : grid.columns), rows(grid.rows);
    SetBlock block;
    PermutationTable order;
    BlockArray shuffled, columns_of, rows_of;
    for (std::size_t begin = 0; begin < samples.size(); begin += kBlockSamples, out += kBlockSamples) {
        const auto part = samples.subspan(begin, std::min(kBlockSamples, samples.size() - begin));
        if (spp <= kMostStrataOfPacks) block.read_set(part, keys, slot_keys, n);
        for (const Slot& slot : run) {
            const std::uint32_t d = slot.dimension;
            float* x_out = out + (d - run.front().dimension) * stride;
            float* y_out = x_out + stride;
            if (spp > kMostStrataOfPacks) {
                fill_points(sampler, part, slot, x_out, stride);
                continue;
            }
            order.set(block, block.slots, d, n);
            order.images(block, block.index_in_set, shuffled.of);
            if (slot.arity == 2) {
                divide(block, shuffled.of, grid.columns, rows_of.of, columns_of.of);
                if (grid.multi_jittered) {
                    order.set(block, block.slots, (std::uint64_t{1} << 32) | d, grid.columns);
                    order.images(block, columns_of.of, columns_of.of);
                    order.set(block, block.slots, (std::uint64_t{2} << 32) | d, grid.rows);
                    order.images(block, rows_of.of, rows_of.of);
                }
            }
            for (std::size_t i = 0; i < block.count; i += kPack) {
                const UInt32 s = UInt32::load(shuffled.of + i);
                const UInt32 jitter = keyed_hash(block.jitter.pack(i), d);
                if (slot.arity == 1) {
                    strata.place(s, jitter).store_first(block.lanes(i), x_out + i);
                    continue;
                }
                UInt32 x = UInt32::load(columns_of.of + i);
                const UInt32 y = UInt32::load(rows_of.of + i);
                if (grid.multi_jittered) x = x * UInt32(grid.rows) + y;
                columns.place(x, jitter).store_first(block.lanes(i), x_out + i);
                const UInt32 jitter_y = keyed_hash(block.jitter.pack(i), d + 1);
                (grid.multi_jittered ? strata.place(s, jitter_y) : rows.place(y, jitter_y)).store_first(block.lanes(i), y_out + i);
            }
        }
    }
}

KOKSMA_MATHS_END

#if HWY_ONCE
namespace koksma {
HWY_EXPORT(fill_stratified);
void StratifiedSampler::fill(std::span<const SampleId> samples, SlotRun run, float* out, std::size_t stride) const noexcept {
    HWY_DYNAMIC_DISPATCH(fill_stratified)(*this, keys_, kSlotKeys, grid_, count_.n, samples, run, out, stride);
}
}  // namespace koksma
#endif
