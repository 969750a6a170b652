#pragma once
// Integer hashing and the one place where integers become floats in [0, 1).

#include <cstdint>

namespace koksma {

/// A pixel of the full film (not of the crop); (0, 0) is the top left corner.
struct Pixel {
    std::int32_t x = 0, y = 0;
    friend constexpr bool operator==(const Pixel&, const Pixel&) = default;
};

/// One camera sample: the pixel and the index of the sample within it.
struct SampleId {
    Pixel pixel;
    std::uint64_t index = 0;
};

/// Reverses the order of all 32 bits.
[[nodiscard]] constexpr std::uint32_t reverse_bits(std::uint32_t x) noexcept {
    x = (x >> 16) | (x << 16);
    x = ((x & 0x00ff00ffu) << 8) | ((x & 0xff00ff00u) >> 8);
    x = ((x & 0x0f0f0f0fu) << 4) | ((x & 0xf0f0f0f0u) >> 4);
    x = ((x & 0x33333333u) << 2) | ((x & 0xccccccccu) >> 2);
    return ((x & 0x55555555u) << 1) | ((x & 0xaaaaaaaau) >> 1);
}

/// Bijective 64-bit mixer.
/// Source: Steele, Lea and Flood 2014, "Fast splittable pseudorandom number generators"; constants of variant 13 of
/// David Stafford, "Better bit mixing".
[[nodiscard]] constexpr std::uint64_t mix64(std::uint64_t x) noexcept {
    x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9ull;
    x = (x ^ (x >> 27)) * 0x94d049bb133111ebull;
    return x ^ (x >> 31);
}

/// 64 bits of key in two words, so that every use of it needs 32-bit arithmetic only and vectorises on any ISA.
struct Key {
    std::uint32_t k0 = 0, k1 = 0;
    friend constexpr bool operator==(const Key&, const Key&) = default;
};

[[nodiscard]] constexpr Key split_key(std::uint64_t h) noexcept {
    return {static_cast<std::uint32_t>(h), static_cast<std::uint32_t>(h >> 32)};
}

[[nodiscard]] constexpr std::uint64_t join_key(Key key) noexcept {
    return (std::uint64_t{key.k1} << 32) | key.k0;
}

/// The key of a pixel under a seed. For one seed, different pixels have different keys (mix64 is bijective); the seed is
/// mixed before the pixel enters, so that no shift of the seed equals a shift of the pixel.
[[nodiscard]] constexpr Key pixel_key(std::uint64_t seed, Pixel p) noexcept {
    const std::uint64_t place = (std::uint64_t{static_cast<std::uint32_t>(p.y)} << 32) | static_cast<std::uint32_t>(p.x);
    return split_key(mix64(mix64(seed + 0x9e3779b97f4a7c15ull) ^ place));
}

/// A key derived from another and a counter (sample index, purpose); different counters give different keys.
[[nodiscard]] constexpr Key derive_key(Key key, std::uint64_t counter) noexcept {
    return split_key(mix64(mix64(join_key(key) ^ 0xd1b54a32d192ed03ull) ^ counter));
}

/// 32 well-mixed bits of (key, counter). Both words of the key take part: two keys agree on all counters only if equal.
/// Source: the multiply-xorshift form and its constants are Chris Wellons' "lowbias32"; that the second word is
/// added between the two rounds is ours (held by the conformance tests' uniformity and independence checks).
[[nodiscard]] constexpr std::uint32_t keyed_hash(Key key, std::uint32_t counter) noexcept {
    std::uint32_t x = counter * 0x9e3779b9u + key.k0;
    x = (x ^ (x >> 16)) * 0x21f0aaadu;
    x = (x ^ (x >> 15)) + key.k1;
    x = (x ^ (x >> 16)) * 0x735a2d97u;
    x = (x ^ (x >> 15)) * 0x21f0aaadu;
    return x ^ (x >> 15);
}

/// The largest float below 1.
inline constexpr float kOneMinusUlp = 0x1.fffffep-1f;

/// The leading 24 bits of a 32-bit binary fraction, truncated.
/// @return  k * 2^-24 in [0, 1), exact; never moves a point into the next elementary interval as rounding would
[[nodiscard]] constexpr float unit_float(std::uint32_t bits) noexcept {
    return static_cast<float>(bits >> 8) * 0x1p-24f;
}

/// The smallest k * 2^-24 that is not below numerator / denominator, capped at 1 - 2^-24.
/// For bases other than 2: truncation would put almost every stratum edge i/b^m into the stratum before it.
/// @param numerator    below denominator
/// @param denominator  in [1, 2^63]
[[nodiscard]] constexpr float unit_float_ceil(std::uint64_t numerator, std::uint64_t denominator) noexcept {
    __extension__ typedef unsigned __int128 Wide;
    const auto k = static_cast<std::uint64_t>(((static_cast<Wide>(numerator) << 24) + (denominator - 1)) / denominator);
    return k >= (1u << 24) ? 1.0f - 0x1p-24f : static_cast<float>(k) * 0x1p-24f;
}

}  // namespace koksma
