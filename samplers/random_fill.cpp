#include "random.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "random_fill.cpp"
#include <koksma/simd/each_target.h>

#include "fill_packs.h"

KOKSMA_MATHS_BEGIN

void fill_random(std::uint64_t seed, std::span<const SampleId> samples, SlotRun run, float* out, std::size_t stride) {
    SampleBlock block;
    SampleKeyArray keys;
    const auto keys_of_seed = [seed](Pixel pixel) { return pixel_key(seed, pixel); };
    for (std::size_t begin = 0; begin < samples.size(); begin += kBlockSamples, out += kBlockSamples) {
        block.read(samples.subspan(begin, std::min(kBlockSamples, samples.size() - begin)), keys_of_seed);
        block.derive_sample_keys(block.keys, keys);
        float* row = out;
        for (std::uint32_t d = run.front().dimension, end = d + dimension_count(run); d < end; ++d, row += stride)
            for (std::size_t i = 0; i < block.count; i += kPack) unit_float(keyed_hash(keys.pack(i), d)).store_first(block.lanes(i), row + i);
    }
}

KOKSMA_MATHS_END

#if HWY_ONCE
namespace koksma {
HWY_EXPORT(fill_random);
void RandomSampler::fill(std::span<const SampleId> samples, SlotRun run, float* out, std::size_t stride) const noexcept {
    if (!run.empty()) HWY_DYNAMIC_DISPATCH(fill_random)(seed_, samples, run, out, stride);
}
}  // namespace koksma
#endif
