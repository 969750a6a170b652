#include "stratified.h"

#include <algorithm>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "stratified_fill.cpp"
#include <koksma/simd/each_target.h>

#include "fill_packs.h"
#include "permutation_packs.h"

KOKSMA_MATHS_BEGIN

/// What all slots of a run share.
struct StratifiedRun {
    const StratifiedGrid grid;
    const std::uint32_t spp;
    const StrataPack strata = StrataPack(spp), columns = StrataPack(grid.multi_jittered ? grid.columns * grid.rows : grid.columns), rows = StrataPack(grid.rows);

    HWY_INLINE void fill_1d(const SetBlock& block, std::uint32_t d, const BlockArray& shuffled, float* out) const {
        for (std::size_t i = 0; i < block.count; i += kPack)
            strata.place(UInt32::load(shuffled.of + i), keyed_hash(block.jitter.pack(i), d)).store_first(block.lanes(i), out + i);
    }
    /// @param cells  room for the permutations of columns and rows
    HWY_INLINE void fill_2d(const SetBlock& block, std::uint32_t d, const BlockArray& shuffled, PermutationTable (&cells)[2], float* x_out, float* y_out) const {
        BlockArray column, row;
        divide(block, shuffled, grid.columns, row, column);
        if (grid.multi_jittered) {
            cells[0].set(block, block.slots, (std::uint64_t{1} << 32) | d, grid.columns);
            cells[1].set(block, block.slots, (std::uint64_t{2} << 32) | d, grid.rows);
            PermutationTable::images<2>(block, cells, {&column, &row}, {&column, &row});
        }
        for (std::size_t i = 0; i < block.count; i += kPack) {
            UInt32 x = UInt32::load(column.of + i);
            const UInt32 y = UInt32::load(row.of + i);
            if (grid.multi_jittered) x = x * UInt32(grid.rows) + y;
            columns.place(x, keyed_hash(block.jitter.pack(i), d)).store_first(block.lanes(i), x_out + i);
            const UInt32 jitter_y = keyed_hash(block.jitter.pack(i), d + 1);
            (grid.multi_jittered ? strata.place(UInt32::load(shuffled.of + i), jitter_y) : rows.place(y, jitter_y)).store_first(block.lanes(i), y_out + i);
        }
    }
};

void fill_stratified(const PixelKeys& keys, std::uint64_t slot_keys, const StratifiedGrid& grid, std::uint64_t spp, std::span<const SampleId> samples,
                     SlotRun run, float* out, std::size_t stride) {
    const StratifiedRun fill{grid, static_cast<std::uint32_t>(spp)};
    SetBlock block;
    PermutationTable orders[2], cells[2];
    BlockArray shuffled[2];
    for (std::size_t begin = 0; begin < samples.size(); begin += kBlockSamples, out += kBlockSamples) {
        block.read_set(samples.subspan(begin, std::min(kBlockSamples, samples.size() - begin)), keys, slot_keys, fill.spp);
        for (std::size_t s = 0; s < run.size(); s += 2) {
            const std::size_t slots = std::min<std::size_t>(2, run.size() - s);
            for (std::size_t k = 0; k < slots; ++k) orders[k].set(block, block.slots, run[s + k].dimension, fill.spp);
            PermutationTable::images_of(slots, block, orders, block.index_in_set, shuffled);
            for (std::size_t k = 0; k < slots; ++k) {
                const std::uint32_t d = run[s + k].dimension;
                float* to = out + (d - run.front().dimension) * stride;
                if (run[s + k].arity == 1)
                    fill.fill_1d(block, d, shuffled[k], to);
                else
                    fill.fill_2d(block, d, shuffled[k], cells, to, to + stride);
            }
        }
    }
}

KOKSMA_MATHS_END

#if HWY_ONCE
namespace koksma {
HWY_EXPORT(fill_stratified);
void StratifiedSampler::fill(std::span<const SampleId> samples, SlotRun run, float* out, std::size_t stride) const noexcept {
    if (count_.n > kMostStrataOfPacks) return fill_points(*this, samples, run, out, stride);
    HWY_DYNAMIC_DISPATCH(fill_stratified)(keys_, kSlotKeys, grid_, count_.n, samples, run, out, stride);
}
}  // namespace koksma
#endif
