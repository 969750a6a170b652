#pragma once
// Nested uniform (Owen) scrambling of 32-bit binary fractions: a hash, and the slow tree that it stands for.

#include <koksma/sampling/bits.h>

namespace koksma {

/// Nested uniform scrambling by a hash in which every bit is changed only by the bits above it.
/// @param x_rev  bit-reversed fraction: bit 0 is the most significant binary digit
/// @param seed   well mixed; one per pixel and dimension
/// @return       the scrambled fraction, bit-reversed
/// Source: the form is Laine and Karras 2011, "Stratified sampling for stochastic transparency"; its use as Owen
/// scrambling is Burley 2020, "Practical hash-based Owen scrambling" (JCGT 9(4)); these constants are Nathan Vegdahl's
/// (psychopath.io, "Building a better LK hash", 2021). Burley's constants fail marginal-variance checks.
[[nodiscard]] constexpr std::uint32_t owen_hash_rev(std::uint32_t x_rev, std::uint32_t seed) noexcept {
    x_rev ^= x_rev * 0x3d20adeau;
    x_rev += seed;
    x_rev *= (seed >> 16) | 1u;
    x_rev ^= x_rev * 0x05526c56u;
    x_rev ^= x_rev * 0x53a22864u;
    return x_rev;
}

/// Nested uniform scrambling as defined: the bit at each node of the binary tree is flipped by a random bit of its own.
/// @param x    fraction, most significant digit in bit 31
/// @param key  one per pixel and dimension
/// Source: Owen 1995, "Randomly permuted (t,m,s)-nets and (t,s)-sequences"
[[nodiscard]] constexpr std::uint32_t owen_tree(std::uint32_t x, Key key) noexcept {
    std::uint32_t y = 0;
    for (int depth = 0; depth < 32; ++depth) {
        // The heap number of the node: a leading 1, then the digits above.
        const std::uint32_t node = static_cast<std::uint32_t>((0x100000000ull | x) >> (32 - depth));
        y = (y << 1) | (((x >> (31 - depth)) ^ (keyed_hash(key, node) >> 31)) & 1u);
    }
    return y;
}

}  // namespace koksma
