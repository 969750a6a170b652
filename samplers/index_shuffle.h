#pragma once
// The order in which a padded sampler visits its points: a nested uniform (Owen) permutation of the sample index.

#include <koksma/sampling/owen_hash.h>

namespace koksma {

/// The counter that gives a pixel the key of its orders.
inline constexpr std::uint64_t kPaddedOrders = 0x6f72646572ull;

/// A permutation of the 64-bit indices that maps every aligned block of 2^m, m <= 32, to an aligned block of 2^m: where all
/// such blocks of a sequence are nets, they still are after it. Digits above the 32nd choose the permutation and stay.
/// @param key      one per pixel, of this purpose alone
/// @param counter  which set of dimensions is padded: its first one
/// Source: Burley 2020, "Practical hash-based Owen scrambling", JCGT 9(4): shuffling
[[nodiscard]] constexpr std::uint64_t shuffled_index(std::uint64_t index, Key key, std::uint32_t counter) noexcept {
    const auto low = static_cast<std::uint32_t>(index), high = static_cast<std::uint32_t>(index >> 32);
    const std::uint32_t seed = keyed_hash(high == 0 ? key : derive_key(key, high), counter);
    return (std::uint64_t{high} << 32) | reverse_bits(owen_hash_rev(reverse_bits(low), seed));
}

}  // namespace koksma
