#pragma once
// How evenly points fill the unit cube: discrepancies, quality parameters, spectra.
// Points are rows of `dimensions` numbers in [0, 1), one point after the other. All costs grow with the square of their number,
// but for the quality parameters.

#include <cstddef>
#include <span>
#include <vector>

namespace koksma {

/// Points as rows. `values.size()` is a multiple of `dimensions`.
struct PointSet {
    std::span<const double> values;
    std::size_t dimensions = 1;
    [[nodiscard]] std::size_t size() const noexcept { return values.size() / dimensions; }
    [[nodiscard]] const double* operator[](std::size_t i) const noexcept { return values.data() + i * dimensions; }
};

/// Star discrepancy, exact: the largest difference between the share of points in a box at the origin and its volume, open and
/// closed boxes both.
/// @throws Error unless there are one or two dimensions and at least one point
/// Source: one dimension Niederreiter 1992, "Random Number Generation and Quasi-Monte Carlo Methods", theorem 2.6; two
/// Bundschuh and Zhu 1993, "A method for exact calculation of the discrepancy of low-dimensional finite point sets", theorem 1
[[nodiscard]] double star_discrepancy(const PointSet& points);

/// What the star discrepancy is known to lie between, ends included.
struct StarBounds {
    double lower = 0, upper = 0;
};

/// Bounds of the star discrepancy in any number of dimensions. Boxes [0, z) are enclosed in brackets low <= z <= high, where
/// share[0, low) - vol(high) and share[0, high] - vol(low) bound what any of them can have; corners give what some do have. The widest
/// bracket is halved until `boxes` were, or none can hold more than what was found: then the two bounds are equal, and exact.
/// @param boxes  how many brackets are halved; each costs as many comparisons as there are numbers in the points
/// @throws Error if there is no point
/// Source: the enclosure is Thiemard 2001, "An algorithm to compute bounds for the star discrepancy", J. Complexity 17(4), theorem 1;
/// that the widest bracket is halved (best first), instead of a partition fixed beforehand, is ours
[[nodiscard]] StarBounds star_discrepancy_bounds(const PointSet& points, std::size_t boxes);

/// L2 discrepancies: root mean square differences over boxes at the origin (star), at the nearest corner (centred), around
/// the torus (wrap-around), and the mixture of the last two. Zero points: NaN.
/// Source: Warnock 1972 (star); Hickernell 1998, "A generalized discrepancy and quadrature error bound" (centred, wrap-around);
/// Zhou, Fang and Ning 2013, "Mixture discrepancy for quasi-random point sets" (mixture)
[[nodiscard]] double l2_star_discrepancy(const PointSet& points) noexcept;
[[nodiscard]] double centred_discrepancy(const PointSet& points) noexcept;
[[nodiscard]] double wraparound_discrepancy(const PointSet& points) noexcept;
[[nodiscard]] double mixture_discrepancy(const PointSet& points) noexcept;

/// The root mean square L2-star discrepancy of n random points: what the others are compared with.
[[nodiscard]] double random_l2_star_discrepancy(std::size_t n, std::size_t dimensions) noexcept;

/// Quality parameter of a net in base 2: the smallest t for which every elementary interval of volume 2^(t - m) holds 2^t of the 2^m
/// points. 0 is best, m says nothing.
/// @param projection  which dimensions, in any order
/// @throws Error unless the number of points is a power of two
[[nodiscard]] int quality_parameter(const PointSet& points, std::span<const std::size_t> projection);

/// Power spectrum |sum exp(-2 pi i f x)|^2 / n of a projection on two dimensions at whole frequencies.
struct Spectrum {
    int largest = 0;              ///< frequencies -largest .. largest in both directions
    std::vector<double> power{};  ///< rows of fy, columns of fx, (2 largest + 1)^2 of them; 0 at the origin
    [[nodiscard]] double at(int fx, int fy) const noexcept {
        return power[static_cast<std::size_t>((fy + largest) * (2 * largest + 1) + fx + largest)];
    }
};
[[nodiscard]] Spectrum power_spectrum(const PointSet& points, std::size_t a, std::size_t b, int largest);

/// Mean power over the frequencies f with k - 1/2 <= |f| < k + 1/2, for k = 1 .. largest; 1 for random points.
[[nodiscard]] std::vector<double> radial_mean(const Spectrum& spectrum);

}  // namespace koksma
