#include "lattice.h"

#include <algorithm>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "lattice_fill.cpp"
#include <koksma/simd/each_target.h>

#include "fill_packs.h"

KOKSMA_MATHS_BEGIN

/// The same bits as koksma::tent for each lane.
HWY_INLINE UInt32 tent_of(UInt32 x) {
    const UInt32 half = 0x80000000u;
    return select(x < half, shift_left<1>(x), select(x == half, UInt32(0xffffffffu), shift_left<1>(UInt32(0u) - x)));
}

void fill_lattice(const PixelKeys& keys, const std::uint32_t* vector, bool fixed, bool shifted, bool tent, std::span<const SampleId> samples, SlotRun run,
                  float* out, std::size_t stride) {
    const auto key_of = [&](Pixel pixel) { return fixed ? Key{} : keys(pixel); };
    const std::uint32_t dimensions = dimension_count(run);
    SampleBlock block;
    PixelTable shift;
    for (std::size_t begin = 0; begin < samples.size(); begin += kBlockSamples, out += kBlockSamples) {
        block.read(samples.subspan(begin, std::min(kBlockSamples, samples.size() - begin)), key_of);
        float* row = out;
        for (std::uint32_t k = 0; k < dimensions; ++k, row += stride) {
            const std::uint32_t d = run.front().dimension + k;
            if (shifted) block.hash_pixels(block.keys, d, shift);
            for (std::size_t i = 0; i < block.count; i += kPack) {
                UInt32 x = reverse_bits(UInt32::load(block.low + i)) * UInt32(vector[d]);
                if (shifted) x = x + block.of_pixel(shift, i);
                unit_float(tent ? tent_of(x) : x).store_first(block.lanes(i), row + i);
            }
        }
    }
}

KOKSMA_MATHS_END

#if HWY_ONCE
namespace koksma {
HWY_EXPORT(fill_lattice);
void LatticeSampler::fill(std::span<const SampleId> samples, SlotRun run, float* out, std::size_t stride) const noexcept {
    HWY_DYNAMIC_DISPATCH(fill_lattice)(keys_, vector_, fixed_, shift_, tent_, samples, run, out, stride);
}
}  // namespace koksma
#endif
