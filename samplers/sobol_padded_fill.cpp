#include "sobol_padded.h"

#include <algorithm>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "sobol_padded_fill.cpp"
#include <koksma/simd/each_target.h>

#include "fill_packs.h"
#include "padded_fill.h"

KOKSMA_MATHS_BEGIN

struct SobolPairs {
    HWY_INLINE UInt32 visited(UInt32 index, UInt32 seed, const Slot&) const { return shuffled_index(index, seed); }
    HWY_INLINE Float value(UInt32 point, UInt32 seed, const Slot&, std::uint32_t k) const {
        return unit_float_rev(owen_hash_rev(k == 0 ? point : pascal_rev(point), seed));
    }
};

void fill_sobol_padded(const SobolPaddedSampler& sampler, const PixelKeys& keys, std::span<const SampleId> samples, SlotRun run, float* out,
                       std::size_t stride) {
    fill_padded_pairs(sampler, keys, SobolPairs{}, samples, run, out, stride);
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
