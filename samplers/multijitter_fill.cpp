#include "multijitter.h"

#include <algorithm>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "multijitter_fill.cpp"
#include <koksma/simd/each_target.h>

#include "fill_packs.h"
#include "permutation_packs.h"

KOKSMA_MATHS_BEGIN

/// Vectorised: 1-D slots, and 2-D slots of correlated full grids.
void fill_multijitter(const MultiJitterSampler& sampler, const PixelKeys& keys, std::uint64_t slot_keys, const MultiJitterGrid& grid, std::uint64_t spp,
                      bool correlated, std::span<const SampleId> samples, SlotRun run, float* out, std::size_t stride) {
    const auto n = static_cast<std::uint32_t>(spp);
    const bool regular = correlated && grid.full();
    const StrataPack strata(n);
    SetBlock block;
    PermutationTable orders[2];
    BlockArray shuffled[2], columns_of, rows_of;
    const auto fill_1d = [&](std::uint32_t d, const BlockArray& strata_of, float* to) HWY_ATTR {
        for (std::size_t i = 0; i < block.count; i += kPack)
            strata.place(UInt32::load(strata_of.of + i), keyed_hash(block.jitter.pack(i), d)).store_first(block.lanes(i), to + i);
    };
    for (std::size_t begin = 0; begin < samples.size(); begin += kBlockSamples, out += kBlockSamples) {
        const auto part = samples.subspan(begin, std::min(kBlockSamples, samples.size() - begin));
        block.read_set(part, keys, slot_keys, n);
        for (std::size_t s = 0; s < run.size(); s += 2) {
            const std::size_t slots = std::min<std::size_t>(2, run.size() - s);
            for (std::size_t k = 0; k < slots; ++k) orders[k].set(block, block.slots, run[s + k].dimension, n);
            PermutationTable::images_of(slots, block, orders, block.index_in_set, shuffled);
            for (std::size_t k = 0; k < slots; ++k) {
                const std::uint32_t d = run[s + k].dimension;
                float* to = out + (d - run.front().dimension) * stride;
                if (run[s + k].arity == 1) {
                    fill_1d(d, shuffled[k], to);
                } else if (!regular) {
                    fill_points(sampler, part, run[s + k], to, stride);
                } else {
                    divide(block, shuffled[k], grid.columns, rows_of, columns_of);
                    orders[0].set(block, block.slots, (std::uint64_t{1} << 32) | d, grid.columns);
                    orders[1].set(block, block.slots, (std::uint64_t{4} << 32) | d, grid.rows);
                    PermutationTable::images<2>(block, orders, {&columns_of, &rows_of}, {&columns_of, &rows_of});
                    for (std::size_t i = 0; i < block.count; i += kPack)
                        (UInt32::load(columns_of.of + i) * UInt32(grid.rows) + UInt32::load(rows_of.of + i)).store(columns_of.of + i);
                    fill_1d(d, columns_of, to);
                    fill_1d(d + 1, shuffled[k], to + stride);
                }
            }
        }
    }
}

KOKSMA_MATHS_END

#if HWY_ONCE
namespace koksma {
HWY_EXPORT(fill_multijitter);
void MultiJitterSampler::fill(std::span<const SampleId> samples, SlotRun run, float* out, std::size_t stride) const noexcept {
    if (count_ > kMostStrataOfPacks) return fill_points(*this, samples, run, out, stride);
    HWY_DYNAMIC_DISPATCH(fill_multijitter)(*this, keys_, kSlotKeys, grid_, count_, correlated_, samples, run, out, stride);
}
}  // namespace koksma
#endif
