// Faults of jittered grids and of Latin hypercubes.

#include "mutant.h"

#include <samplers/permutation.h>
#include <samplers/stratum.h>

#include <cmath>
#include <map>

namespace koksma::mutation {

namespace {

Key pixel(const At& a) noexcept { return pixel_key(a.seed, a.pixel); }
/// The key of the order of a slot, and of the jitter of a number.
Key order_key(const At& a) noexcept { return derive_key(pixel(a), ~std::uint64_t{a.slot}); }
double jitter(const At& a) noexcept { return keyed_hash(derive_key(pixel(a), a.index), a.dimension) * 0x1p-32; }
std::uint32_t count(const At& a) noexcept { return static_cast<std::uint32_t>(a.spp); }
std::uint32_t order(const At& a) noexcept { return permute(static_cast<std::uint32_t>(a.index), count(a), order_key(a)); }

float place(std::uint64_t stratum, std::uint64_t n, double jitter) noexcept { return stratum_float(stratum, n, 0x1p24 / static_cast<double>(n), jitter); }

/// The cells of a 2-D slot: a square where spp is one, spp columns otherwise.
std::uint32_t columns(const At& a) noexcept {
    const auto root = static_cast<std::uint32_t>(std::lround(std::sqrt(static_cast<double>(a.spp))));
    return root * root == count(a) ? root : count(a);
}
/// Which of how many strata a number lies in, given the place of its sample in the order of the slot.
struct Stratum {
    std::uint32_t stratum, n;
};
Stratum stratum(const At& a, std::uint32_t place) noexcept {
    if (a.arity == 1) return {place, count(a)};
    return a.dimension == a.slot ? Stratum{place % columns(a), columns(a)} : Stratum{place / columns(a), count(a) / columns(a)};
}
float jittered(const At& a, std::uint32_t order, double jitter) noexcept {
    const Stratum s = stratum(a, order);
    return place(s.stratum, s.n, jitter);
}

/// Kensler's permutation and random number, with patterns that are adjacent integers.
/// Source: Kensler 2013, "Correlated Multi-Jittered Sampling" (Pixar TM 13-01), listings 4 and 5
std::uint32_t kensler_permute(std::uint32_t i, std::uint32_t l, std::uint32_t p) noexcept {
    std::uint32_t w = l - 1;
    for (const int s : {1, 2, 4, 8, 16}) w |= w >> s;
    do {
        i ^= p, i *= 0xe170893d, i ^= p >> 16, i ^= (i & w) >> 4, i ^= p >> 8, i *= 0x0929eb3f, i ^= p >> 23, i ^= (i & w) >> 1;
        i *= 1 | p >> 27, i *= 0x6935fa69, i ^= (i & w) >> 11, i *= 0x74dcb303, i ^= (i & w) >> 2, i *= 0x9e501cc3, i ^= (i & w) >> 2;
        i *= 0xc860a3df, i &= w, i ^= i >> 5;
    } while (i >= l);
    return (i + p) % l;
}

/// A textbook shuffle of [0, n), swapping j = n - 1 .. 1 with other(hash, j). Kept, as drawing asks for one place at a time.
template <class Other>
std::uint32_t shuffled(const At& a, Other other) {
    static std::map<std::pair<std::uint64_t, std::uint64_t>, std::vector<std::uint32_t>> kept;
    if (kept.size() > 64) kept.clear();
    std::vector<std::uint32_t>& v = kept[{join_key(order_key(a)), a.spp}];
    if (v.empty()) {
        for (std::uint32_t j = 0; j < count(a); ++j) v.push_back(j);
        for (std::uint32_t j = count(a); j-- > 1;) std::swap(v[j], v[other(keyed_hash(order_key(a), j), j)]);
    }
    return v[a.index % a.spp];
}

}  // namespace

Family jitter_family() {
    Family f{.name = "jitter",
             .info = {.name = {}, .title = {}, .paper = {}, .kind = SamplerKind::set, .joint = 2, .good_counts = {GoodCounts::Rule::square}, .max_samples = kMaxStrata},
             .promises = {.strata_of_set = true, .cells_of_set = true, .multiples_of_2_24 = true},
             .healthy = [](At a) noexcept { return jittered(a, order(a), jitter(a)); }};
    // Counts that are not squares have one row, whose points are as random as those of a square set.
    f.mutants = {
        {"no jitter", "the centres of the cells", [](At a) noexcept { return jittered(a, order(a), 0.5); }},
        {"half jitter", "the middle half of each cell", [](At a) noexcept { return jittered(a, order(a), 0.25 + 0.5 * jitter(a)); }},
        {"one jitter for all cells", "a shifted grid",
         [](At a) noexcept {
             const std::uint32_t place = order(a);
             a.index = std::uint64_t{1} << 40;
             return jittered(a, place, jitter(a));
         }},
        {"one jitter for x and y", "points on the diagonals of the cells",
         [](At a) noexcept {
             At x = a;
             x.dimension = a.slot;
             return jittered(a, order(a), jitter(x));
         }},
        {"x only", "y is random", [](At a) noexcept { return a.arity == 2 && a.dimension != a.slot ? place(0, 1, jitter(a)) : jittered(a, order(a), jitter(a)); }},
        {"cells off by one", "the first is empty, the last full",
         [](At a) noexcept {
             const Stratum s = stratum(a, order(a));
             return place(std::min(s.stratum + 1, s.n - 1), s.n, jitter(a));
         }},
        {"cells swapped", "one in twenty points of the first stratum goes to the last",
         [](At a) noexcept {
             const Stratum s = stratum(a, order(a));
             return place(s.stratum == 0 && jitter(a) < 0.05 ? s.n - 1 : s.stratum, s.n, jitter(a));
         }},
        {"pixels alike", "the key does not see the pixel",
         [](At a) noexcept {
             a.pixel = {};
             return jittered(a, order(a), jitter(a));
         }},
        {"no shuffle", "samples of all slots are in the order of the cells", [](At a) noexcept { return jittered(a, static_cast<std::uint32_t>(a.index), jitter(a)); }},
        {"shuffle shared", "all slots are in one order",
         [](At a) noexcept {
             At first = a;
             first.slot = 0;
             return jittered(a, order(first), jitter(a));
         }},
        {"hash of adjacent integers", "Kensler's permutation with pattern seed + pixel + slot (Mitsuba stratified: 1.4 % of the mean at 4 spp)",
         [](At a) noexcept {
             const auto pattern = static_cast<std::uint32_t>(a.seed) + static_cast<std::uint32_t>(a.pixel.y * 2048 + a.pixel.x) + a.slot;
             return jittered(a, kensler_permute(static_cast<std::uint32_t>(a.index), count(a), pattern), jitter(a));
         }},
        {"computed in float", "(cell + jitter) / n: other cells, and 1 (pbrt stratified)",
         [](At a) noexcept {
             const Stratum s = stratum(a, order(a));
             return (static_cast<float>(s.stratum) + static_cast<float>(jitter(a))) / static_cast<float>(s.n);
         }},
    };
    return f;
}

Family lhs_family() {
    Family f{.name = "lhs",
             .info = {.name = {}, .title = {}, .paper = {}, .kind = SamplerKind::set, .max_samples = 4096},
             .promises = {.strata_of_set = true, .strata_of_pairs = true, .multiples_of_2_24 = true},
             .healthy = [](At a) noexcept {
                 a.slot = a.dimension;
                 return place(order(a), a.spp, jitter(a));
             }};
    f.mutants = {
        {"naive shuffle", "every place is swapped with any place",
         [](At a) noexcept {
             a.slot = a.dimension;
             const auto n = count(a);
             return place(shuffled(a, [n](std::uint32_t h, std::uint32_t) { return h % n; }), a.spp, jitter(a));
         }},
        {"Sattolo's shuffle", "an off by one: no element stays where it is",
         [](At a) noexcept {
             a.slot = a.dimension;
             return place(shuffled(a, [](std::uint32_t h, std::uint32_t j) { return h % j; }), a.spp, jitter(a));
         }},
        {"one permutation", "the same for all dimensions",
         [](At a) noexcept {
             a.slot = 0;
             return place(order(a), a.spp, jitter(a));
         }},
        {"no jitter", "the centres of the strata",
         [](At a) noexcept {
             a.slot = a.dimension;
             return place(order(a), a.spp, 0.5);
         }},
        {"rotations only", "index + key modulo spp",
         [](At a) noexcept {
             a.slot = a.dimension;
             return place((a.index + keyed_hash(order_key(a), 0)) % a.spp, a.spp, jitter(a));
         }},
        {"second dimension reversed", "dimension 2 k + 1 runs against dimension 2 k",
         [](At a) noexcept {
             a.slot = a.dimension & ~1u;
             return place(a.dimension & 1u ? count(a) - 1 - order(a) : order(a), a.spp, jitter(a));
         }},
        {"no permutation of dimension 0", "sample i of every replicate lies in stratum i",
         [](At a) noexcept {
             a.slot = a.dimension;
             return place(a.dimension == 0 ? static_cast<std::uint32_t>(a.index) : order(a), a.spp, jitter(a));
         }},
    };
    return f;
}

}  // namespace koksma::mutation
