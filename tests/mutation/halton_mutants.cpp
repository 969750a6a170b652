// Faults of the Halton sequence: bases, digits, permutations, the width of the index.

#include "mutant.h"

#include <samplers/stratum.h>

#include <array>

namespace koksma::mutation {

namespace {

constexpr std::uint32_t kDimensions = 64;
constexpr std::array<std::uint32_t, kDimensions> kBases = [] {
    std::array<std::uint32_t, kDimensions> bases{};
    std::uint32_t n = 2;
    for (std::uint32_t& b : bases) {
        for (bool prime = false; !prime; ++n) {
            prime = true;
            for (std::uint32_t q = 2; q * q <= n; ++q) prime = prime && n % q != 0;
            b = n;
        }
    }
    return bases;
}();

std::uint64_t key(const At& a) noexcept { return join_key(derive_key(pixel_key(a.seed, a.pixel), a.dimension)); }

/// A permutation of [0, base), the one of (key, node of the tree of digits), applied to a digit.
std::uint64_t affine(std::uint64_t digit, std::uint64_t base, std::uint64_t key, std::uint64_t node) noexcept {
    const std::uint64_t h = mix64(key ^ node), factor = 1 + (((h >> 40) * (base - 1)) >> 24), offset = ((h & 0xffffff) * base) >> 24;
    return (digit * factor + offset) % base;
}

/// The radical inverse in a base with digits permuted by permute(digit, depth, digits before), as many as `digits` allows, and a
/// uniform number below the last.
template <class Permute>
float radical(const At& a, std::uint64_t base, Permute permute, std::uint64_t below, bool keep_below = true, int digits = 99) noexcept {
    std::uint64_t stratum = 0, count = 1, before = 0, n = a.index;
    for (int depth = 0; count * base <= kMaxStrata && depth < digits; ++depth, n /= base) {
        stratum = stratum * base + permute(n % base, depth, before, n);
        count *= base;
        before = before * base + n % base;
    }
    const double rest = keep_below ? static_cast<double>(mix64(below ^ before ^ 0x1234567) >> 11) * 0x1p-53 : 0;
    return stratum_float(stratum, count, 0x1p24 / static_cast<double>(count), rest);
}

float owen(const At& a, std::uint64_t base, std::uint64_t key) noexcept {
    return radical(
        a, base, [&](std::uint64_t digit, int depth, std::uint64_t before, std::uint64_t) { return affine(digit, base, key, (static_cast<std::uint64_t>(depth) << 32) | before); },
        key);
}
float healthy(At a) noexcept { return owen(a, kBases[a.dimension], key(a)); }
float plain(At a) noexcept {
    std::uint64_t numerator = 0, denominator = 1;
    for (std::uint64_t n = a.index, b = kBases[a.dimension]; n != 0 && denominator < (std::uint64_t{1} << 50); n /= b) {
        numerator = numerator * b + n % b;
        denominator *= b;
    }
    return unit_float_ceil(numerator, denominator);
}

}  // namespace

Family halton_family() {
    Family f{.name = "halton",
             .info = {.name = {}, .title = {}, .paper = {}, .joint = 0, .max_dimensions = kDimensions},
             .promises = {.strata_prime_bases = true, .nested_scrambling = true, .multiples_of_2_24 = true},
             .healthy = healthy};
    f.mutants = {
        {"base 4", "dimension 2", [](At a) noexcept { return owen(a, a.dimension == 2 ? 4 : kBases[a.dimension], key(a)); }},
        {"base 3 twice", "dimension 2 is in base 3, as dimension 1", [](At a) noexcept { return owen(a, a.dimension == 2 ? 3 : kBases[a.dimension], key(a)); }},
        {"leading zeros not scrambled", "digits above the last of the index stay zero",
         [](At a) noexcept {
             const std::uint64_t b = kBases[a.dimension], k = key(a);
             return radical(
                 a, b,
                 [&](std::uint64_t digit, int depth, std::uint64_t before, std::uint64_t rest) {
                     return rest == 0 ? 0 : affine(digit, b, k, (static_cast<std::uint64_t>(depth) << 32) | before);
                 },
                 k, false);
         }},
        {"digits up to 1024", "as many digits as 1024 points need",
         [](At a) noexcept {
             const std::uint64_t b = kBases[a.dimension], k = key(a);
             int digits = 0;
             for (std::uint64_t n = b; n <= 1024; n *= b) ++digits;
             return radical(
                 a, b, [&](std::uint64_t digit, int depth, std::uint64_t before, std::uint64_t) { return affine(digit, b, k, (static_cast<std::uint64_t>(depth) << 32) | before); },
                 k, false, digits);
         }},
        {"one permutation a place", "does not depend on the digits before: not nested",
         [](At a) noexcept {
             const std::uint64_t b = kBases[a.dimension], k = key(a);
             return radical(
                 a, b, [&](std::uint64_t digit, int depth, std::uint64_t, std::uint64_t) { return affine(digit, b, k, static_cast<std::uint64_t>(depth) << 32); }, k);
         }},
        {"zero stays zero", "permutations of the other digits only",
         [](At a) noexcept {
             const std::uint64_t b = kBases[a.dimension], k = key(a);
             return radical(
                 a, b,
                 [&](std::uint64_t digit, int depth, std::uint64_t before, std::uint64_t) {
                     const std::uint64_t h = mix64(k ^ (static_cast<std::uint64_t>(depth) << 32) ^ before);
                     return digit * (1 + (((h >> 40) * (b - 1)) >> 24)) % b;
                 },
                 k, false);
         }},
        {"one key", "all dimensions have the permutations of the first", [](At a) noexcept {
             const std::uint32_t d = a.dimension;
             a.dimension = 0;
             return owen(a, kBases[d], key(a));
         }},
        {"not scrambled", "every seed gives the sequence itself", plain},
        {"one shift", "Cranley-Patterson rotation, the same for all dimensions",
         [](At a) noexcept {
             const float u = plain(a) + unit_float(keyed_hash(pixel_key(a.seed, a.pixel), 0));
             return u < 1 ? u : u - 1;
         }},
        {"index of 1000", "the points repeat",
         [](At a) noexcept {
             a.index %= 1000;
             return healthy(a);
         }},
        {"stride overflows 32 bits", "index * 31104 in int: other points from sample 69,043 on (pbrt at 128 pixels and more)",
         [](At a) noexcept {
             a.index = static_cast<std::uint64_t>(static_cast<std::int32_t>(a.index * 31104));
             return healthy(a);
         }},
        {"repeats every 128 pixels", "pbrt",
         [](At a) noexcept {
             a.pixel = {a.pixel.x & 127, a.pixel.y & 127};
             return healthy(a);
         }},
        {"wraps to dimension 2", "silently after the last (pbrt, at 1000; here after 40)",
         [](At a) noexcept {
             if (a.dimension >= 40) a.dimension = 2 + (a.dimension - 40) % 38;
             return healthy(a);
         }},
        {"digits truncated to float", "the point below the edge of its stratum",
         [](At a) noexcept {
             double x = 0, b = kBases[a.dimension], w = 1 / b;
             std::uint64_t before = 0, n = a.index, k = key(a);
             for (int depth = 0; w > 0x1p-30; ++depth, n /= kBases[a.dimension], w /= b) {
                 x += w * static_cast<double>(affine(n % kBases[a.dimension], kBases[a.dimension], k, (static_cast<std::uint64_t>(depth) << 32) | before));
                 before = before * kBases[a.dimension] + n % kBases[a.dimension];
             }
             return static_cast<float>(x);  // and to nearest: up to 1
         }},
    };
    return f;
}

Family plain_halton_family() {
    Family f{.name = "halton:none",
             .info = {.name = {}, .title = {}, .paper = {}, .joint = 0, .max_dimensions = kDimensions},
             .promises = {.strata_prime_bases = true, .multiples_of_2_24 = true, .reference_points = conformance::halton_reference_points()},
             .randomized = false,
             .healthy = plain};
    f.mutants = {
        {"starts at 1", "the point of index 0 is left out",
         [](At a) noexcept {
             ++a.index;
             return plain(a);
         }},
        {"truncated", "116 of 120 edges of base 3 fall into the stratum before",
         [](At a) noexcept {
             double x = 0, b = kBases[a.dimension], w = 1 / b;
             for (std::uint64_t n = a.index; n != 0; n /= kBases[a.dimension], w /= b) x += w * static_cast<double>(n % kBases[a.dimension]);
             return static_cast<float>(static_cast<std::int32_t>(x * 0x1p24)) * 0x1p-24f;
         }},
    };
    return f;
}

}  // namespace koksma::mutation
