#include "lhs.h"

#include <algorithm>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "lhs_fill.cpp"
#include <koksma/simd/each_target.h>

#include "fill_packs.h"
#include "permutation_packs.h"

KOKSMA_MATHS_BEGIN

void fill_lhs(const PixelKeys& keys, std::uint64_t order_keys, std::uint32_t n, std::span<const SampleId> samples, SlotRun run, float* out, std::size_t stride) {
    const std::uint32_t dimensions = dimension_count(run);
    const StrataPack strata(n);
    SetBlock block;
    PermutationTable orders[2];
    BlockArray strata_of[2];
    for (std::size_t begin = 0; begin < samples.size(); begin += kBlockSamples, out += kBlockSamples) {
        block.read_set(samples.subspan(begin, std::min(kBlockSamples, samples.size() - begin)), keys, order_keys, n);
        for (std::uint32_t first = 0; first < dimensions; first += 2) {
            const std::uint32_t many = std::min(2u, dimensions - first), d = run.front().dimension + first;
            for (std::uint32_t k = 0; k < many; ++k) orders[k].set(block, block.slots, d + k, n);
            PermutationTable::images_of(many, block, orders, block.index_in_set, strata_of);
            for (std::uint32_t k = 0; k < many; ++k) {
                float* row = out + (first + k) * stride;
                for (std::size_t i = 0; i < block.count; i += kPack)
                    strata.place(UInt32::load(strata_of[k].of + i), keyed_hash(block.jitter.pack(i), d + k)).store_first(block.lanes(i), row + i);
            }
        }
    }
}

KOKSMA_MATHS_END

#if HWY_ONCE
namespace koksma {
HWY_EXPORT(fill_lhs);
void LhsSampler::fill(std::span<const SampleId> samples, SlotRun run, float* out, std::size_t stride) const noexcept {
    if (count_ > kMostStrataOfPacks) return fill_points(*this, samples, run, out, stride);
    HWY_DYNAMIC_DISPATCH(fill_lhs)(keys_, kOrderKeys, count_, samples, run, out, stride);
}
}  // namespace koksma
#endif
