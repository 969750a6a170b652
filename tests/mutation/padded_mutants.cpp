// Faults of padding: how the order of one slot is made to differ from that of the next.

#include "mutant.h"

#include <samplers/sobol.h>

namespace koksma::mutation {

namespace {

std::uint32_t scramble(std::uint32_t bits, std::uint32_t key) noexcept { return reverse_bits(owen_hash_rev(reverse_bits(bits), key)); }
Key pixel(const At& a) noexcept { return pixel_key(a.seed, a.pixel); }
std::uint32_t order_key(const At& a) noexcept { return keyed_hash(derive_key(pixel(a), 1), a.slot); }
std::uint32_t value_key(const At& a) noexcept { return keyed_hash(derive_key(pixel(a), 2), a.dimension); }
std::uint32_t index(const At& a) noexcept { return static_cast<std::uint32_t>(a.index); }

/// A coordinate of the first two of Sobol', in an order and under a scramble of its own.
float draw(const At& a, std::uint32_t shuffled, std::uint32_t key) noexcept {
    return unit_float(scramble(reverse_bits(sobol_rev(sobol_matrices(), shuffled, a.dimension - a.slot)), key));
}
/// The index is shuffled by the scramble of its digits, so that aligned blocks of 2^m stay together.
/// Source: Burley 2020, "Practical hash-based Owen scrambling" (JCGT 9(4)), section 5
std::uint32_t shuffled(const At& a) noexcept { return scramble(index(a), order_key(a)); }

}  // namespace

Family padded_family() {
    Family f{.name = "padded",
             .info = {.name = {}, .title = {}, .paper = {}, .joint = 2, .good_counts = {GoodCounts::Rule::power, 2}, .max_samples = std::uint64_t{1} << 32},
             .promises = {.strata_base = 2, .net_of_pairs = true, .nested_scrambling = true, .multiples_of_2_24 = true},
             .healthy = [](At a) noexcept { return draw(a, shuffled(a), value_key(a)); }};
    f.mutants = {
        {"no shuffle", "all slots are in one order", [](At a) noexcept { return draw(a, index(a), value_key(a)); }},
        {"shuffle from the last digit", "bit reversal forgotten: blocks do not stay together",
         [](At a) noexcept { return draw(a, owen_hash_rev(index(a), order_key(a)), value_key(a)); }},
        {"shuffle by xor", "the order of one slot is that of another, xored", [](At a) noexcept { return draw(a, index(a) ^ order_key(a), value_key(a)); }},
        {"shuffle shared", "all slots are shuffled alike",
         [](At a) noexcept { return draw(a, scramble(index(a), keyed_hash(derive_key(pixel(a), 1), 0)), value_key(a)); }},
        {"shuffle by rotation", "index + key modulo spp",
         [](At a) noexcept { return draw(a, static_cast<std::uint32_t>((a.index + order_key(a)) % a.spp), value_key(a)); }},
        {"scramble shared by slots", "the key sees the place within the slot only",
         [](At a) noexcept { return draw(a, shuffled(a), keyed_hash(derive_key(pixel(a), 2), a.dimension - a.slot)); }},
        {"shuffle ignores the seed", "the order is the same in every replicate (pbrt zsobol)",
         [](At a) noexcept { return draw(a, scramble(index(a), keyed_hash(derive_key(pixel_key(0, a.pixel), 1), a.slot)), value_key(a)); }},
        {"single numbers from a generator", "1-D slots are random, outside the sequence (Tungsten)",
         [](At a) noexcept {
             return a.arity == 1 ? unit_float(keyed_hash(derive_key(pixel(a), a.index + 3), a.dimension)) : draw(a, shuffled(a), value_key(a));
         }},
        {"slots two apart alike", "keys see slot / 4",
         [](At a) noexcept {
             const std::uint32_t k = a.dimension - a.slot;
             a.slot -= a.slot % 4;
             return unit_float(scramble(reverse_bits(sobol_rev(sobol_matrices(), scramble(index(a), order_key(a)), k)), keyed_hash(derive_key(pixel(a), 2), a.slot + k)));
         }},
    };
    return f;
}

}  // namespace koksma::mutation
