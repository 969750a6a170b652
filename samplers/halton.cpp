#include "halton.h"

#include "stratum.h"

#include <algorithm>
#include <cstddef>
#include <vector>

namespace koksma {
namespace {

__extension__ typedef unsigned __int128 Wide;

struct HaltonTable {
    std::vector<std::uint16_t> inverses;
    std::vector<HaltonBase> bases;

    HaltonTable() : bases(kPrimeCount) {
        std::size_t size = 0;
        for (const std::uint32_t p : kPrimes) size += p;
        inverses.resize(size + 1);  // vectorised look-ups read two entries at once
        std::uint16_t* inverse = inverses.data();
        for (std::size_t d = 0; d < kPrimeCount; ++d) {
            const std::uint32_t p = kPrimes[d];
            std::uint32_t digits = 1;
            std::uint64_t cells = 1;
            for (; cells * p < kMaxStrata; cells *= p) ++digits;
            bases[d] = {.base = p,
                        .digits = digits,
                        .reciprocal = ~std::uint64_t{0} / p + 1,
                        .cells = cells,
                        .scale = 0x1p24 / static_cast<double>(cells),
                        .inverse_base = 1.0 / p,
                        .inverse = inverse};
            inverse[1] = 1;  // then from p = q i + r: 1/i = -q / r (mod p)
            for (std::uint32_t i = 2; i < p; ++i) inverse[i] = static_cast<std::uint16_t>((p - p / i) * inverse[p % i] % p);
            inverse += p;
        }
    }
};

/// The digits of the index, mirrored at the radix point: numerator / denominator.
struct Fraction {
    Wide numerator, denominator;
};
Fraction mirrored(const HaltonBase& b, std::uint64_t n) noexcept {
    // 64-bit index and 13-bit base: the denominator stays below 2^77, and its product with 2^32 fits.
    Fraction f{0, 1};
    while (n != 0) {
        const std::uint64_t q = b.quotient(n);
        f.numerator = f.numerator * b.base + (n - q * b.base);
        f.denominator *= b.base;
        n = q;
    }
    return f;
}

/// As `mirrored`, for an index below 2^26 / base: the denominator stays at or below 2^26.
struct ShortFraction {
    std::uint32_t numerator, denominator;
};
ShortFraction mirrored_short(const HaltonBase& b, std::uint64_t n) noexcept {
    ShortFraction f{0, 1};
    while (n != 0) {
        const std::uint64_t q = b.quotient(n);
        f.numerator = f.numerator * b.base + static_cast<std::uint32_t>(n - q * b.base);
        f.denominator *= b.base;
        n = q;
    }
    return f;
}
bool is_short(const HaltonBase& b, std::uint64_t index) noexcept { return index < (1u << 26) && index * b.base <= (1u << 26); }

/// A point of the scrambled sequence: the digits of the index are permuted, and the zeros that follow them too, down to the last
/// that a float can tell apart.
/// @tparam nested  each permutation depends on the digits before (owen), or on the place alone (digits)
template <bool nested>
float scrambled(const HaltonBase& b, std::uint64_t index, Key key) noexcept {
    std::uint64_t n = index;
    std::uint32_t before = 0, weight = 1, cell = 0;  // of the digits so far: their number, base^places, and the number of their images
    const auto digit = [&] { return static_cast<std::uint32_t>(n - b.quotient(n) * b.base); };
    const auto zeros = [&] { return keyed_hash(key, kZeroImages | before); };
    const auto permutation = [&](std::uint32_t place) { return keyed_hash(key, (place << 24) | before); };

    std::uint32_t place = 0;
    for (; n != 0 && place + 1 < b.digits; ++place) {
        const std::uint32_t d = digit();
        cell = cell * b.base + permuted_digit(b, d, product_high(zeros() * weight, b.base), permutation(place));
        if constexpr (nested) before += d * weight;
        weight *= b.base;
        n = b.quotient(n);
    }
    // The places up to that of the finest strata, if the index has no digits there.
    const std::uint32_t left = static_cast<std::uint32_t>(b.cells) / weight;
    cell = cell * left + product_high(zeros() * weight, left);
    // What is within a stratum: the rest of the same number, and the one digit of the index that matters there.
    const std::uint32_t rest = zeros() * static_cast<std::uint32_t>(b.cells);
    double position = rest * 0x1p-32;
    if (const std::uint32_t d = digit(); d != 0)
        position = (permuted_digit(b, d, product_high(rest, b.base), permutation(place)) + (rest * b.base) * 0x1p-32) * b.inverse_base;
    return stratum_float(cell, b.cells, b.scale, position);
}

HaltonSampler::Randomize parse(const std::string& name) {
    if (name == "none") return HaltonSampler::Randomize::none;
    if (name == "cp") return HaltonSampler::Randomize::shift;
    return name == "digits" ? HaltonSampler::Randomize::digits : HaltonSampler::Randomize::owen;
}

}  // namespace

const HaltonBase* halton_bases() {
    static const HaltonTable table;
    return table.bases.data();
}

float radical_inverse(const HaltonBase& b, std::uint64_t index) noexcept {
    if (b.base == 2) return unit_float(radical_inverse_bits(b, index));
    if (is_short(b, index)) {
        // 2^24 numerator / denominator is 0, or at least 2^-26 away from integers (base and 2 are coprime); a double is 2^-29 off.
        const ShortFraction f = mirrored_short(b, index);
        if (f.numerator == 0) return 0;
        const auto k = static_cast<std::int64_t>(f.numerator * 0x1p24 / f.denominator) + 1;
        return static_cast<float>(std::min<std::int64_t>(k, 0xffffff)) * 0x1p-24f;
    }
    const Fraction f = mirrored(b, index);
    const auto k = static_cast<std::int64_t>(((f.numerator << 24) + (f.denominator - 1)) / f.denominator);
    return static_cast<float>(std::min<std::int64_t>(k, 0xffffff)) * 0x1p-24f;
}

std::uint32_t radical_inverse_bits(const HaltonBase& b, std::uint64_t index) noexcept {
    if (b.base == 2) return reverse_bits(static_cast<std::uint32_t>(index));  // digits beyond 32 have no place in 32 bits
    if (is_short(b, index)) {
        const ShortFraction f = mirrored_short(b, index);  // odd base: at least 2^-26 away from integers; a double is 2^-21 off
        auto k = static_cast<std::uint64_t>(static_cast<std::int64_t>(f.numerator * 0x1p32 / f.denominator));
        k -= k * f.denominator > (std::uint64_t{f.numerator} << 32);
        return static_cast<std::uint32_t>(k);
    }
    const Fraction f = mirrored(b, index);
    return static_cast<std::uint32_t>((f.numerator << 32) / f.denominator);
}

float HaltonSampler::Point::value(std::uint32_t dimension) const noexcept {
    const HaltonBase& b = bases_[dimension];
    switch (randomize_) {
        case Randomize::none: return radical_inverse(b, index_);
        case Randomize::shift: return unit_float(radical_inverse_bits(b, index_) + keyed_hash(key_, dimension));
        case Randomize::digits:
            if (b.base == 2) return unit_float(radical_inverse_bits(b, index_) ^ keyed_hash(key_, dimension));
            return scrambled<false>(b, index_, split_key(mix64(digit_key_ ^ dimension)));
        case Randomize::owen: break;
    }
    if (b.base == 2) return unit_float(reverse_bits(owen_hash_rev(static_cast<std::uint32_t>(index_), keyed_hash(key_, dimension))));
    return scrambled<true>(b, index_, split_key(mix64(digit_key_ ^ dimension)));
}

SamplerInfo HaltonSampler::info() {
    return {.name = "halton",
            .title = "Halton",
            .paper = "Halton 1964, Algorithm 247: Radical-inverse quasi-random point sequence",
            .version = 2,
            .options = {{.name = "randomize",
                         .default_value = "owen",
                         .values = {"none", "cp", "digits", "owen"},
                         .help = "nothing, shift modulo 1, a permutation per digit place, nested permutations",
                         .always_shown = true},
                        pixels_option()},
            .joint = 0,
            .max_dimensions = kPrimeCount};
}

HaltonSampler::HaltonSampler(const SamplerOptions& options, const SamplingPlan& plan)
    : keys_(options, plan, 0x68616c746f6eull), bases_(halton_bases()), randomize_(parse(options["randomize"])) {}

}  // namespace koksma
