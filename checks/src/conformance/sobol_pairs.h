#pragma once
// The quality parameter t of the two-dimensional projections of the Sobol' sequence with the direction numbers new-joe-kuo-6
// (Joe and Kuo 2008): dimensions a and b, first 2^m points. Scrambling does not change t, and t is not monotone in m.
// Origin: counted over all elementary intervals of scipy's unscrambled points, by a program independent of this one.

#include <array>

namespace koksma::conformance {

struct SobolPair {
    int a, b;
    std::array<int, 5> t;  ///< for m = 4, 6, 8, 10, 12
};

inline constexpr std::array<SobolPair, 45> kSobolPairs{{
    {0, 1, {0, 0, 0, 0, 0}}, {0, 2, {0, 1, 1, 1, 1}}, {0, 3, {2, 1, 1, 2, 1}}, {0, 4, {1, 2, 1, 2, 2}},
    {0, 5, {3, 2, 3, 2, 3}}, {0, 6, {1, 1, 1, 1, 2}}, {0, 7, {1, 1, 3, 0, 2}}, {0, 8, {1, 1, 2, 4, 1}},
    {0, 9, {1, 2, 2, 1, 3}}, {1, 2, {1, 1, 1, 1, 1}}, {1, 3, {1, 0, 2, 1, 2}}, {1, 4, {1, 0, 2, 1, 2}},
    {1, 5, {0, 2, 0, 2, 1}}, {1, 6, {3, 1, 3, 2, 3}}, {1, 7, {2, 4, 2, 3, 1}}, {1, 8, {2, 3, 1, 2, 2}},
    {1, 9, {0, 1, 2, 1, 3}}, {2, 3, {0, 1, 1, 1, 2}}, {2, 4, {2, 3, 1, 2, 2}}, {2, 5, {1, 2, 1, 2, 2}},
    {2, 6, {1, 0, 2, 2, 2}}, {2, 7, {1, 1, 1, 2, 2}}, {2, 8, {1, 3, 4, 2, 2}}, {2, 9, {2, 0, 2, 2, 3}},
    {3, 4, {2, 1, 1, 3, 2}}, {3, 5, {0, 2, 2, 3, 3}}, {3, 6, {1, 2, 2, 1, 2}}, {3, 7, {1, 1, 3, 2, 2}},
    {3, 8, {1, 2, 4, 2, 2}}, {3, 9, {1, 1, 1, 3, 2}}, {4, 5, {0, 1, 3, 1, 2}}, {4, 6, {0, 2, 2, 1, 1}},
    {4, 7, {1, 2, 3, 1, 3}}, {4, 8, {1, 3, 1, 2, 2}}, {4, 9, {1, 1, 2, 1, 1}}, {5, 6, {1, 1, 2, 2, 1}},
    {5, 7, {1, 0, 2, 1, 2}}, {5, 8, {1, 1, 2, 3, 1}}, {5, 9, {1, 3, 1, 2, 4}}, {6, 7, {2, 1, 2, 1, 3}},
    {6, 8, {2, 1, 3, 1, 1}}, {6, 9, {0, 1, 2, 2, 2}}, {7, 8, {3, 1, 2, 2, 2}}, {7, 9, {0, 2, 3, 2, 2}},
    {8, 9, {0, 1, 2, 3, 2}},
}};

}  // namespace koksma::conformance
