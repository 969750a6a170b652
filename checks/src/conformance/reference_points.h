#pragma once
// Published points of unscrambled sequences.
// Origin: scipy.stats.qmc.Sobol and Halton (scipy's k-th point of Sobol' is that of index k ^ (k >> 1) here: it draws in Gray-code
// order, we in the order of the index), checked against exact radical inverses.

#include <koksma/conformance/subject.h>

namespace koksma::conformance {

namespace detail {
/// @param bits  of the coordinates, 32 binary digits each, as many as are known
template <class... Bits>
constexpr ReferencePoint sobol_point(std::uint64_t index, Bits... bits) {
    ReferencePoint p{.index = index};
    std::size_t d = 0;
    ((p.numerators[d] = std::uint64_t{bits}, p.denominators[d++] = std::uint64_t{1} << 32), ...);
    return p;
}
}  // namespace detail

/// Sobol' with the direction numbers new-joe-kuo-6 (Joe and Kuo 2008), 32 binary digits.
inline constexpr std::array kSobolPoints{
    detail::sobol_point(0, 0u, 0u, 0u, 0u, 0u, 0u, 0u, 0u),
    detail::sobol_point(1, 0x80000000u, 0x80000000u, 0x80000000u, 0x80000000u, 0x80000000u),
    detail::sobol_point(2, 0x40000000u, 0xc0000000u, 0xc0000000u, 0xc0000000u, 0x40000000u),
    detail::sobol_point(3, 0xc0000000u, 0x40000000u, 0x40000000u, 0x40000000u, 0xc0000000u),
    detail::sobol_point(4, 0x20000000u, 0xa0000000u, 0x60000000u, 0x20000000u, 0x20000000u),
    detail::sobol_point(5, 0xa0000000u, 0x20000000u, 0xe0000000u, 0xa0000000u, 0xa0000000u),
    detail::sobol_point(6, 0x60000000u, 0x60000000u, 0xa0000000u, 0xe0000000u, 0x60000000u),
    detail::sobol_point(7, 0xe0000000u, 0xe0000000u, 0x20000000u, 0x60000000u, 0xe0000000u),
    detail::sobol_point(1023, 0xffc00000u, 0x41400000u, 0xbb400000u, 0x70c00000u, 0xe6400000u, 0x41c00000u, 0xbc400000u, 0x4bc00000u),
    detail::sobol_point(0xabcde, 0x7b3d5000u, 0x96eb3000u, 0x61015000u, 0xedaf7000u, 0x055c1000u, 0xac077000u, 0x8e481000u, 0xb42dd000u),
};

/// Halton in the first primes.
inline constexpr std::array kHaltonPoints{
    ReferencePoint{.index = 0, .numerators = {0, 0, 0, 0}, .denominators = {1, 1, 1, 1}},
    ReferencePoint{.index = 1, .numerators = {1, 1, 1, 1}, .denominators = {2, 3, 5, 7}},
    ReferencePoint{.index = 2, .numerators = {1, 2, 2, 2}, .denominators = {4, 3, 5, 7}},
    ReferencePoint{.index = 3, .numerators = {3, 1, 3, 3}, .denominators = {4, 9, 5, 7}},
    ReferencePoint{.index = 4, .numerators = {1, 4, 4, 4}, .denominators = {8, 9, 5, 7}},
    ReferencePoint{.index = 5, .numerators = {5, 7, 1, 5}, .denominators = {8, 9, 25, 7}},
    ReferencePoint{.index = 6, .numerators = {3, 2, 6, 6}, .denominators = {8, 9, 25, 7}},
    ReferencePoint{.index = 12345, .numerators = {9987, 4849, 2973, 11961, 4035}, .denominators = {16384, 19683, 15625, 16807, 14641}},
};

}  // namespace koksma::conformance
