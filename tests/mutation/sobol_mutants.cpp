// Faults of a joint Sobol' sequence: its matrices, its index, its scramble, its keys, its output.

#include "mutant.h"

#include <samplers/sobol.h>

namespace koksma::mutation {

namespace {

/// The point without randomization, 32 digits. `dimension` may be another than the one asked for.
std::uint32_t matrix(std::uint64_t index, std::uint32_t dimension) noexcept {
    return reverse_bits(sobol_rev(sobol_matrices(), index, dimension));
}
std::uint32_t matrix(const At& a) noexcept { return matrix(a.index, a.dimension); }
std::uint32_t key(const At& a) noexcept { return keyed_hash(pixel_key(a.seed, a.pixel), a.dimension); }
std::uint32_t scramble(std::uint32_t bits, std::uint32_t key) noexcept { return reverse_bits(owen_hash_rev(reverse_bits(bits), key)); }

float healthy(At a) noexcept { return unit_float(scramble(matrix(a), key(a))); }
/// Healthy, but for a matrix.
float with_matrix(const At& a, std::uint32_t bits) noexcept { return unit_float(scramble(bits, key(a))); }
/// Only the leading digits are scrambled.
float leading_scrambled(const At& a, std::uint32_t mask) noexcept {
    const std::uint32_t plain = matrix(a);
    return unit_float((scramble(plain, key(a)) & mask) | (plain & ~mask));
}
/// Owen's tree with a node and a rule for flipping of one's own.
template <class Node>
float tree(const At& a, Node node, std::uint32_t flip_below = 0x80000000u) noexcept {
    const std::uint32_t x = matrix(a);
    const Key k = derive_key(pixel_key(a.seed, a.pixel), a.dimension);
    std::uint32_t y = 0;
    for (int depth = 0; depth < 24; ++depth) {
        const bool flip = keyed_hash(k, node(static_cast<std::uint32_t>((0x100000000ull | x) >> (32 - depth)), depth, x)) < flip_below;
        y |= (((x >> (31 - depth)) & 1u) ^ (flip ? 1u : 0u)) << (31 - depth);
    }
    return unit_float(y);
}
/// The columns of a matrix, one after the other, for a rule of one's own.
template <class Column>
std::uint32_t columns(std::uint64_t index, Column column) noexcept {
    std::uint32_t x = 0;
    for (std::uint32_t c = 0; index != 0; index >>= 1, ++c)
        if (index & 1u) x ^= column(c);
    return x;
}

std::vector<Mutant> matrix_mutants() {
    return {
        {"swapped dimensions", "dimensions 2 and 3 exchange matrices",
         [](At a) noexcept { return with_matrix(a, matrix(a.index, a.dimension == 2 || a.dimension == 3 ? 5 - a.dimension : a.dimension)); }},
        {"duplicate matrix", "dimension 3 has the matrix of dimension 2",
         [](At a) noexcept { return with_matrix(a, matrix(a.index, a.dimension == 3 ? 2 : a.dimension)); }},
        {"flipped bit", "one bit of one direction number of dimension 3",
         [](At a) noexcept { return with_matrix(a, matrix(a) ^ (a.dimension == 3 && (a.index >> 4 & 1u) ? 0x20000000u : 0u)); }},
        {"shifted columns", "dimension 3 begins with its second direction number",
         [](At a) noexcept {
             return with_matrix(a, a.dimension != 3 ? matrix(a) : columns(a.index, [](std::uint32_t c) { return sobol_direction(3, c + 1); }));
         }},
        {"reversed columns", "dimension 1 is the identity with its columns in reverse order",
         [](At a) noexcept {
             return with_matrix(a, a.dimension != 1 ? matrix(a) : columns(a.index, [](std::uint32_t c) { return c < 32 ? 1u << c : 0u; }));
         }},
        {"wrong polynomial", "columns of dimension 4 from the sixth on are those of dimension 5",
         [](At a) noexcept {
             return with_matrix(a, a.dimension != 4 ? matrix(a) : columns(a.index, [](std::uint32_t c) { return sobol_direction(c < 5 ? 4 : 5, c); }));
         }},
        {"first point skipped", "index + 1: no prefix of 2^m points is a net",
         [](At a) noexcept {
             ++a.index;
             return healthy(a);
         }},
        {"index cut at 1024", "the points repeat",
         [](At a) noexcept {
             a.index &= 1023;
             return healthy(a);
         }},
        {"index of 32 bits", "index + 2^32 is index",
         [](At a) noexcept {
             a.index &= 0xffffffffu;
             return healthy(a);
         }},
        {"wraps to dimension 2", "silently after 1024 dimensions (pbrt)",
         [](At a) noexcept {
             if (a.dimension >= 1024) a.dimension = 2 + (a.dimension - 1024) % 1022;
             return healthy(a);
         }},
    };
}

std::vector<Mutant> scramble_mutants() {
    return {
        {"8 digits scrambled", "the digits below are those of the sequence", [](At a) noexcept { return leading_scrambled(a, 0xff000000u); }},
        {"4 digits scrambled", "the digits below are those of the sequence", [](At a) noexcept { return leading_scrambled(a, 0xf0000000u); }},
        {"16 digits scrambled", "the digits below are those of the sequence", [](At a) noexcept { return leading_scrambled(a, 0xffff0000u); }},
        {"not scrambled", "every seed gives the sequence itself (pbrt sobol without randomization, in replicates)",
         [](At a) noexcept { return unit_float(matrix(a)); }},
        {"dimension 1 not scrambled", "an offset of one", [](At a) noexcept { return a.dimension == 1 ? unit_float(matrix(a)) : healthy(a); }},
        {"digital shift only", "xor with the key instead of nested scrambling", [](At a) noexcept { return unit_float(matrix(a) ^ key(a)); }},
        {"scramble without bit reversal", "the hash runs from the last digit to the first",
         [](At a) noexcept { return unit_float(owen_hash_rev(matrix(a), key(a))); }},
        {"prefix with own bit", "a flip depends on the digit that it flips",
         [](At a) noexcept { return tree(a, [](std::uint32_t node, int depth, std::uint32_t x) { return node * 2 + (x >> (31 - depth) & 1u); }); }},
        {"prefix one short", "a flip does not depend on the digit just above",
         [](At a) noexcept {
             return tree(a, [](std::uint32_t node, int depth, std::uint32_t) { return depth == 0 ? 1u : (node >> 1) | (static_cast<std::uint32_t>(depth) << 25); });
         }},
        {"biased flips", "a digit is flipped with probability 1/4",
         [](At a) noexcept { return tree(a, [](std::uint32_t node, int, std::uint32_t) { return node; }, 0x40000000u); }},
        {"8 digits out", "values are multiples of 2^-8", [](At a) noexcept { return unit_float(scramble(matrix(a), key(a)) & 0xff000000u); }},
        {"16 digits out", "values are multiples of 2^-16", [](At a) noexcept { return unit_float(scramble(matrix(a), key(a)) & 0xffff0000u); }},
        {"rounded to float", "32 digits times 2^-32: into the next elementary interval, and to 1 (pbrt Owen, FastOwen)",
         [](At a) noexcept { return static_cast<float>(scramble(matrix(a), key(a))) * 0x1p-32f; }},
    };
}

std::vector<Mutant> key_mutants() {
    return {
        {"one key", "all dimensions are scrambled alike",
         [](At a) noexcept { return unit_float(scramble(matrix(a), keyed_hash(pixel_key(a.seed, a.pixel), 0))); }},
        {"key shared by a pair", "dimensions 0 and 1 are scrambled alike",
         [](At a) noexcept { return unit_float(scramble(matrix(a), keyed_hash(pixel_key(a.seed, a.pixel), a.dimension == 1 ? 0 : a.dimension))); }},
        {"dimension 1 is dimension 0", "matrix and key",
         [](At a) noexcept {
             if (a.dimension == 1) a.dimension = 0;
             return healthy(a);
         }},
        {"one xor for all dimensions", "as in Mitsuba's ldsampler and Tungsten",
         [](At a) noexcept { return unit_float(matrix(a) ^ keyed_hash(pixel_key(a.seed, a.pixel), 0)); }},
        {"weak key", "seed * 8 + dimension, not hashed",
         [](At a) noexcept {
             const auto place = static_cast<std::uint32_t>(a.pixel.x * 64 + a.pixel.y * 4096);
             return unit_float(scramble(matrix(a), static_cast<std::uint32_t>(a.seed) * 8 + a.dimension + place));
         }},
        {"key of 16 bits", "65536 scrambles for all seeds, pixels and dimensions",
         [](At a) noexcept { return unit_float(scramble(matrix(a), key(a) & 0xffffu)); }},
        {"pixels alike", "the key does not see the pixel",
         [](At a) noexcept {
             a.pixel = {};
             return healthy(a);
         }},
        {"pixels in pairs", "pixels 2 k and 2 k + 1 share a key",
         [](At a) noexcept {
             a.pixel.x >>= 1;
             return healthy(a);
         }},
        {"pixels two apart", "x and x + 2 share a key",
         [](At a) noexcept {
             a.pixel.x = (a.pixel.x >> 2) * 2 + (a.pixel.x & 1);
             return healthy(a);
         }},
        {"pixels on diagonals", "the key sees x + y only",
         [](At a) noexcept {
             a.pixel = {a.pixel.x + a.pixel.y, 0};
             return healthy(a);
         }},
        {"repeats every 256 pixels", "OpenQMC, every sampler",
         [](At a) noexcept {
             a.pixel = {a.pixel.x & 255, a.pixel.y & 255};
             return healthy(a);
         }},
        {"seeds ignored", "replicates are equal (pbrt halton/owen)",
         [](At a) noexcept {
             a.seed = 0;
             return healthy(a);
         }},
        {"eight seeds", "seed & 7",
         [](At a) noexcept {
             a.seed &= 7;
             return healthy(a);
         }},
        {"seeds of 16 bits", "seed + 65536 is seed (OpenQMC)",
         [](At a) noexcept {
             a.seed &= 0xffff;
             return healthy(a);
         }},
        {"seeds of 32 bits", "seed + 2^32 is seed",
         [](At a) noexcept {
             a.seed &= 0xffffffffu;
             return healthy(a);
         }},
        {"seeds in pairs", "seeds 2 k and 2 k + 1 are equal",
         [](At a) noexcept {
             a.seed >>= 1;
             return healthy(a);
         }},
        {"seeds slide", "seed f + 1 at pixel x is seed f at x + 1 (OpenQMC)",
         [](At a) noexcept {
             a.pixel.x += static_cast<std::int32_t>(a.seed);
             a.seed = 0;
             return healthy(a);
         }},
        {"seed + spp slides", "seed s + spp is seed s one pixel on (Mitsuba ldsampler)",
         [](At a) noexcept {
             const auto place = static_cast<std::uint64_t>(a.pixel.y * 2048 + a.pixel.x);
             return unit_float(scramble(matrix(a), keyed_hash(split_key(mix64(a.seed + place * a.spp)), a.dimension)));
         }},
        {"index + 65536 is the next seed", "OpenQMC",
         [](At a) noexcept {
             a.seed += a.index >> 16;
             a.index &= 0xffff;
             return healthy(a);
         }},
        {"seeds slide over domains", "seed f + 1 in dimension k is seed f in dimension k + 1 (OpenQMC blue noise)",
         [](At a) noexcept { return unit_float(scramble(matrix(a), keyed_hash(pixel_key(a.seed + a.dimension, a.pixel), 0))); }},
        {"seeds move low digits only", "the two leading digits depend on the pixel alone: errors of replicates correlate (pbrt pmj02bn)",
         [](At a) noexcept {
             const std::uint32_t y = scramble(matrix(a), key(a));
             a.seed = 0;
             return unit_float((scramble(matrix(a), key(a)) & 0xc0000000u) | (y & 0x3fffffffu));
         }},
    };
}

Family described(std::string name) {
    return {.name = std::move(name),
            .info = {.name = {}, .title = {}, .paper = {}, .joint = 0, .good_counts = {GoodCounts::Rule::power, 2}, .max_dimensions = kSobolDimensions},
            .promises = {.strata_base = 2, .net_of_first_pair = true, .sobol_projections = true, .multiples_of_2_24 = true},
            .healthy = healthy};
}

}  // namespace

Family sobol_family() {
    Family f = described("sobol");
    f.promises.nested_scrambling = true;
    for (const auto& part : {matrix_mutants(), scramble_mutants(), key_mutants()}) f.mutants.insert(f.mutants.end(), part.begin(), part.end());
    return f;
}

/// Under scrambling these are as good as the sequence itself, and no check may reject them; without, they are other points.
Family plain_sobol_family() {
    Family f = described("sobol:none");
    f.randomized = false;
    f.promises.reference_points = conformance::sobol_reference_points();
    f.healthy = [](At a) noexcept { return unit_float(matrix(a)); };
    f.mutants = {
        {"Gray-code order", "the order of incremental generators", [](At a) noexcept { return unit_float(matrix(a.index ^ (a.index >> 1), a.dimension)); }},
        {"shifted columns of dimension 1", "a legal linear scramble of Pascal's matrix",
         [](At a) noexcept {
             return unit_float(a.dimension != 1 ? matrix(a) : columns(a.index, [](std::uint32_t c) {
                 return sobol_direction(1, c) ^ (c > 0 ? sobol_direction(1, c) >> 1 : 0u);
             }));
         }},
        {"index xor 5", "another order within blocks of 8", [](At a) noexcept { return unit_float(matrix(a.index ^ 5u, a.dimension)); }},
    };
    return f;
}

/// Sobol' under a Cranley-Patterson rotation: still N^-1, no longer a net.
Family rotated_family() {
    Family f{.name = "rotated sobol",
             .info = {.name = {}, .title = {}, .paper = {}, .joint = 0, .good_counts = {GoodCounts::Rule::power, 2}, .max_dimensions = kSobolDimensions},
             .promises = {.strata_base = 2, .multiples_of_2_24 = true},
             .healthy = [](At a) noexcept { return unit_float(matrix(a) + key(a)); }};
    f.mutants = {
        {"shift shared by parity", "every second dimension is rotated by the same number (LuxCore)",
         [](At a) noexcept { return unit_float(matrix(a) + keyed_hash(pixel_key(a.seed, a.pixel), a.dimension & 1u)); }},
        {"times 1/0xffffffff", "the largest numbers round to 1 (LuxCore)",
         [](At a) noexcept { return static_cast<float>(matrix(a) + key(a)) * (1.0f / static_cast<float>(0xffffffffu)); }},
        {"shift of 8 bits", "256 rotations",
         [](At a) noexcept { return unit_float(matrix(a) + (key(a) & 0xff000000u)); }},
    };
    return f;
}

}  // namespace koksma::mutation
