#pragma once
// The first two dimensions of the Sobol' sequence in closed form, without tables and with all 64 digits.

#include <koksma/sampling/bits.h>

namespace koksma {

/// Dimension 1 of the Sobol' sequence; dimension 0 is the index itself. Bit r is the binary digit of 2^-(r+1).
/// Digit r is the sum modulo 2 of all index bits c with binomial(c, r) odd, that is (Lucas) with r a subset of c in binary:
/// six steps, one a binary digit of the places. The map is its own inverse.
/// Source: Sobol' 1967; Faure 1982, "Discrepance de suites associees a un systeme de numeration": the Pascal matrix modulo 2
[[nodiscard]] constexpr std::uint64_t pascal_rev(std::uint64_t index) noexcept {
    index ^= (index >> 1) & 0x5555555555555555ull;
    index ^= (index >> 2) & 0x3333333333333333ull;
    index ^= (index >> 4) & 0x0f0f0f0f0f0f0f0full;
    index ^= (index >> 8) & 0x00ff00ff00ff00ffull;
    index ^= (index >> 16) & 0x0000ffff0000ffffull;
    return index ^ (index >> 32);
}

/// Reverses the order of all 64 bits.
[[nodiscard]] constexpr std::uint64_t reverse_bits64(std::uint64_t x) noexcept {
    return (std::uint64_t{reverse_bits(static_cast<std::uint32_t>(x))} << 32) | reverse_bits(static_cast<std::uint32_t>(x >> 32));
}

}  // namespace koksma
