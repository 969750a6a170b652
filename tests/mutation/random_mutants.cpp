// Faults of a generator of random numbers, and of any sampler as a program.

#include "mutant.h"

namespace koksma::mutation {

namespace {

std::uint32_t bits(const At& a) noexcept { return keyed_hash(derive_key(pixel_key(a.seed, a.pixel), a.index), a.dimension); }
float healthy(At a) noexcept { return unit_float(bits(a)); }

}  // namespace

Family random_family() {
    Family f{.name = "random", .promises = {.multiples_of_2_24 = true, .independent_samples = true}, .healthy = healthy};
    f.mutants = {
        {"next sample's dimension 0", "is dimension 1 of this one",
         [](At a) noexcept {
             if (a.dimension == 1) a.dimension = 0, ++a.index;
             return healthy(a);
         }},
        {"generator of 16 bits", "x * 25173 + 13849 mod 2^16, seeded with place and seed",
         [](At a) noexcept {
             auto x = static_cast<std::uint32_t>(a.index * 8 + a.dimension + a.seed * 977) + static_cast<std::uint32_t>(a.pixel.x * 31 + a.pixel.y * 77);
             for (int k = 0; k < 3; ++k) x = (x * 25173 + 13849) & 0xffffu;
             return static_cast<float>(x) * 0x1p-16f;
         }},
        {"12 digits out", "values are multiples of 2^-12", [](At a) noexcept { return unit_float(bits(a) & 0xfff00000u); }},
        {"antithetic", "every second sample is 1 - the one before",
         [](At a) noexcept {
             const bool mirrored = a.index & 1u;
             a.index &= ~std::uint64_t{1};
             return unit_float(mirrored ? ~bits(a) : bits(a));
         }},
        {"range up to 0.999", "the last thousandth is never drawn",
         [](At a) noexcept { return unit_float(static_cast<std::uint32_t>(bits(a) * 0.999)); }},
        {"rounded to float", "2^32 - 1 becomes 1", [](At a) noexcept { return static_cast<float>(bits(a)) * 0x1p-32f; }},
        {"top bit biased", "set once more in 32 draws",
         [](At a) noexcept {
             At other = a;
             other.dimension += 5000;
             return unit_float(bits(a) | ((bits(other) & 31u) == 0 ? 0x80000000u : 0u));
         }},
        {"nested domains shifted", "the numbers of a slot are those of the slot before, moved by one (OpenQMC)",
         [](At a) noexcept {
             a.dimension = a.slot / 2 + (a.dimension - a.slot);
             return healthy(a);
         }},
        {"index shifted by dimension", "dimension d of sample i is dimension 0 of sample i + d",
         [](At a) noexcept {
             a.index += a.dimension;
             a.dimension = 0;
             return healthy(a);
         }},
        {"index of 32 bits", "index + 2^32 is index",
         [](At a) noexcept {
             a.index &= 0xffffffffu;
             return healthy(a);
         }},
        {"depends on spp", "a sequence whose prefix changes with the plan",
         [](At a) noexcept {
             a.seed ^= a.spp << 20;
             return healthy(a);
         }},
        {"keeps state", "a hidden counter: values depend on the order of calls",
         [](At a) noexcept {
             static std::uint32_t calls = 0;
             a.seed += ++calls / 1000;
             return healthy(a);
         }},
        {"exactly 1", "once in 4096 draws", [](At a) noexcept { return bits(a) >> 20 == 0xfff ? 1.0f : healthy(a); }},
        {"negative", "once in 4096 draws", [](At a) noexcept { return bits(a) >> 20 == 0xfff ? -0x1p-24f : healthy(a); }},
        {"not a number", "once in 4096 draws", [](At a) noexcept { return bits(a) >> 20 == 0xfff ? std::numeric_limits<float>::quiet_NaN() : healthy(a); }},
    };
    return f;
}

}  // namespace koksma::mutation
