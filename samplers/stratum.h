#pragma once
// A float that lies in its stratum: the conversion shared by stratified and the randomised Halton sequence.

#include <cstdint>

namespace koksma {

/// The most strata that all contain a multiple of 2^-24.
inline constexpr std::uint64_t kMaxStrata = 1u << 24;

/// A multiple of 2^-24 in [stratum / count, (stratum + 1) / count), near (stratum + position) / count.
/// @param stratum   below count
/// @param count     in [1, 2^24]
/// @param scale     2^24 / count, rounded to double
/// @param position  in [0, 1)
/// @note  Truncation leaves the stratum below when the edge is not a multiple of 2^-24; rounding and the ceiling leave it
///        above. The product in double is only a guess: the two comparisons are exact, in integers.
[[nodiscard]] constexpr float stratum_float(std::uint64_t stratum, std::uint64_t count, double scale, double position) noexcept {
    auto k = static_cast<std::uint64_t>(static_cast<std::int64_t>((static_cast<double>(stratum) + position) * scale));
    k += k * count < (stratum << 24);
    k -= k * count >= ((stratum + 1) << 24);
    return static_cast<float>(static_cast<std::int64_t>(k)) * 0x1p-24f;
}

}  // namespace koksma
