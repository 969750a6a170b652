#include "kronecker.h"

#include <algorithm>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "kronecker_fill.cpp"
#include <koksma/simd/each_target.h>

#include "fill_packs.h"
#include "padded_fill.h"

KOKSMA_MATHS_BEGIN

/// The same bits as koksma::kronecker_bits for each lane, indices below 2^32.
HWY_INLINE UInt32 multiple(UInt32 index, std::uint64_t step) {
    const UInt32 low = static_cast<std::uint32_t>(step), high = static_cast<std::uint32_t>(step >> 32);
    return product_high(index, low) + index * high + UInt32(0x80000000u);
}

struct KroneckerPairs {
    bool randomized;
    HWY_INLINE UInt32 visited(UInt32 index, UInt32 seed, const Slot& slot) const {
        return randomized || slot.dimension != 0 ? shuffled_index(index, seed) : index;
    }
    HWY_INLINE Float value(UInt32 point, UInt32 seed, const Slot& slot, std::uint32_t k) const {
        const UInt32 x = multiple(point, slot.arity == 1 ? kR1 : k == 0 ? kR2x : kR2y);
        return unit_float(randomized ? x + seed : x);
    }
};

void fill_kronecker(const KroneckerSampler& sampler, const PixelKeys& keys, bool randomized, std::span<const SampleId> samples, SlotRun run,
                    float* out, std::size_t stride) {
    const auto key_of = [&](Pixel pixel) { return randomized ? keys(pixel) : Key{}; };
    fill_padded_pairs(sampler, key_of, KroneckerPairs{randomized}, samples, run, out, stride);
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
