#pragma once
// The tail: numbers for draws without a bound. A counter hash, the same for every sampler.

#include <koksma/sampling/bits.h>
#include <koksma/sampling/slot.h>

namespace koksma {

/// Number k of a draw that has no slot: bounces past the layout or past a sampler's largest dimension, further events at
/// one bounce. A pure function of its arguments; independent of every sampler (its key has a constant of its own).
/// @return  [0, 1)
[[nodiscard]] constexpr float tail_sample(std::uint64_t seed, const SampleId& id, std::uint32_t bounce, SlotRole role,
                                          std::uint32_t k) noexcept {
    const Key key = derive_key(pixel_key(seed ^ 0x7461696c7461696cull, id.pixel), id.index);  // "tailtail"
    return unit_float(keyed_hash(derive_key(key, (std::uint64_t{bounce} << 8) | static_cast<std::uint64_t>(role)), k));
}

}  // namespace koksma
