#pragma once
// Seeds of replicates: every (scene, sampler, spp, replicate) has its own, and no test can produce one of a reference.

#include <koksma/sampling/bits.h>

#include <cstdint>
#include <string_view>

namespace koksma {

/// Seeds that a user may give, and all that test_seed makes, are below this; those of references are at or above it.
inline constexpr std::uint64_t kReferenceSeedBit = std::uint64_t{1} << 63;

/// FNV-1a, for names.
[[nodiscard]] constexpr std::uint64_t hash_text(std::string_view text) noexcept {
    std::uint64_t h = 0xcbf29ce484222325ull;
    for (const char c : text) h = (h ^ static_cast<unsigned char>(c)) * 0x100000001b3ull;
    return h;
}

/// Order-dependent combination.
[[nodiscard]] constexpr std::uint64_t hash_combine(std::uint64_t a, std::uint64_t b) noexcept { return mix64(mix64(a + 0x9e3779b97f4a7c15ull) ^ b); }

namespace detail {
[[nodiscard]] constexpr std::uint64_t replicate_hash(std::uint64_t base, std::uint64_t scene, std::string_view sampler, std::uint64_t spp,
                                                     std::uint64_t replicate) noexcept {
    return hash_combine(hash_combine(hash_combine(hash_combine(base, scene), hash_text(sampler)), spp), replicate);
}
}  // namespace detail

/// The seed of one measured render; different spp have disjoint seeds, so that points of a curve are independent.
[[nodiscard]] constexpr std::uint64_t test_seed(std::uint64_t base, std::uint64_t scene, std::string_view sampler, std::uint64_t spp,
                                                std::uint64_t replicate) noexcept {
    return detail::replicate_hash(base, scene, sampler, spp, replicate) & ~kReferenceSeedBit;
}

/// The seed of one replicate of a reference.
[[nodiscard]] constexpr std::uint64_t reference_seed(std::uint64_t scene, std::string_view sampler, std::uint64_t replicate) noexcept {
    return detail::replicate_hash(0x7265666572656e63ull, scene, sampler, 0, replicate) | kReferenceSeedBit;
}

}  // namespace koksma
