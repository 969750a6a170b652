#include <koksma/measure/point_set.h>

#include <koksma/sampling/error.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>
#include <numeric>
#include <string>

namespace koksma {

namespace {

double star_of_line(const PointSet& points) {
    std::vector<double> x(points.values.begin(), points.values.end());
    std::sort(x.begin(), x.end());
    const auto n = static_cast<double>(x.size());
    double worst = 0;
    for (std::size_t i = 0; i < x.size(); ++i)
        worst = std::max({worst, x[i] - static_cast<double>(i) / n, static_cast<double>(i + 1) / n - x[i]});
    return worst;
}

double star_of_square(const PointSet& points) {
    const std::size_t count = points.size();
    const auto n = static_cast<double>(count);
    std::vector<std::size_t> by_x(count);
    std::iota(by_x.begin(), by_x.end(), std::size_t{0});
    std::sort(by_x.begin(), by_x.end(), [&](std::size_t i, std::size_t j) { return points[i][0] < points[j][0]; });
    std::vector<double> y{0, 1};  // of the points so far, between two ends
    double worst = 0;
    for (std::size_t l = 0; l <= count; ++l) {
        const double x = l == 0 ? 0 : points[by_x[l - 1]][0], next = l == count ? 1 : points[by_x[l]][0];
        for (std::size_t k = 0; k <= l; ++k) {
            const double share = static_cast<double>(k) / n;
            worst = std::max({worst, std::abs(share - x * y[k]), std::abs(share - next * y[k + 1])});
        }
        if (l < count) {
            const double added = points[by_x[l]][1];
            y.insert(std::upper_bound(y.begin(), y.end() - 1, added), added);
        }
    }
    return worst;
}

/// constant + a / n sum_i prod_d one(x) + 1 / n^2 sum_ij prod_d two(x, y), and its root.
template <class One, class Two>
double l2(const PointSet& points, double constant, double factor, One one, Two two) noexcept {
    const std::size_t count = points.size();
    if (count == 0) return std::numeric_limits<double>::quiet_NaN();
    const auto n = static_cast<double>(count);
    double singles = 0, diagonal = 0, pairs = 0;
    for (std::size_t i = 0; i < count; ++i) {
        double product = 1, self = 1;
        for (std::size_t d = 0; d < points.dimensions; ++d) product *= one(points[i][d]), self *= two(points[i][d], points[i][d]);
        singles += product;
        diagonal += self;
        for (std::size_t j = 0; j < i; ++j) {
            double both = 1;
            for (std::size_t d = 0; d < points.dimensions; ++d) both *= two(points[i][d], points[j][d]);
            pairs += both;
        }
    }
    return std::sqrt(std::max(0.0, constant + factor * singles / n + (diagonal + 2 * pairs) / (n * n)));
}

/// Whether every box of 2^-k[0] x .. over the projection holds 2^t of the points.
bool even(const PointSet& points, std::span<const std::size_t> projection, std::span<const int> k, int volume, int t) {
    std::vector<std::uint32_t> count(std::size_t{1} << volume, 0);
    for (std::size_t i = 0; i < points.size(); ++i) {
        std::size_t box = 0;
        for (std::size_t d = 0; d < projection.size(); ++d)
            box = (box << k[d]) | static_cast<std::size_t>(std::ldexp(points[i][projection[d]], k[d]));
        if (++count[box] > std::uint32_t{1} << t) return false;
    }
    return true;
}

/// Calls f for all k[d] >= 0 that sum to `rest`, until it says no.
template <class F>
bool all_shapes(std::vector<int>& k, std::size_t d, int rest, const F& f) {
    if (d + 1 == k.size()) {
        k[d] = rest;
        return f();
    }
    for (k[d] = 0; k[d] <= rest; ++k[d])
        if (!all_shapes(k, d + 1, rest - k[d], f)) return false;
    return true;
}

}  // namespace

double star_discrepancy(const PointSet& points) {
    if (points.size() == 0 || points.dimensions > 2)
        throw Error("the exact star discrepancy is for one or two dimensions and at least one point; there are " +
                    std::to_string(points.dimensions) + " and " + std::to_string(points.size()));
    return points.dimensions == 1 ? star_of_line(points) : star_of_square(points);
}

double l2_star_discrepancy(const PointSet& points) noexcept {
    const auto d = static_cast<double>(points.dimensions);
    return l2(points, std::pow(3, -d), -std::pow(2, 1 - d), [](double x) { return 1 - x * x; }, [](double x, double y) { return 1 - std::max(x, y); });
}

double centred_discrepancy(const PointSet& points) noexcept {
    const auto from_centre = [](double x) { return std::abs(x - 0.5); };
    return l2(
        points, std::pow(13.0 / 12, static_cast<double>(points.dimensions)), -2,
        [=](double x) { return 1 + 0.5 * from_centre(x) - 0.5 * from_centre(x) * from_centre(x); },
        [=](double x, double y) { return 1 + 0.5 * from_centre(x) + 0.5 * from_centre(y) - 0.5 * std::abs(x - y); });
}

double wraparound_discrepancy(const PointSet& points) noexcept {
    return l2(
        points, -std::pow(4.0 / 3, static_cast<double>(points.dimensions)), 0, [](double) { return 0.0; },
        [](double x, double y) { return 1.5 - std::abs(x - y) * (1 - std::abs(x - y)); });
}

double mixture_discrepancy(const PointSet& points) noexcept {
    const auto from_centre = [](double x) { return std::abs(x - 0.5); };
    return l2(
        points, std::pow(19.0 / 12, static_cast<double>(points.dimensions)), -2,
        [=](double x) { return 5.0 / 3 - 0.25 * from_centre(x) - 0.25 * from_centre(x) * from_centre(x); },
        [=](double x, double y) {
            const double apart = std::abs(x - y);
            return 15.0 / 8 - 0.25 * from_centre(x) - 0.25 * from_centre(y) - 0.75 * apart + 0.5 * apart * apart;
        });
}

double random_l2_star_discrepancy(std::size_t n, std::size_t dimensions) noexcept {
    const auto d = static_cast<double>(dimensions);
    return std::sqrt((std::pow(2, -d) - std::pow(3, -d)) / static_cast<double>(n));
}

int quality_parameter(const PointSet& points, std::span<const std::size_t> projection) {
    if (!std::has_single_bit(points.size()))
        throw Error("a quality parameter in base 2 is of 2^m points; there are " + std::to_string(points.size()));
    const int m = std::countr_zero(points.size());
    std::vector<int> k(projection.size(), 0);
    for (int t = 0; t < m; ++t)
        if (all_shapes(k, 0, m - t, [&] { return even(points, projection, k, m - t, t); })) return t;
    return m;
}

Spectrum power_spectrum(const PointSet& points, std::size_t a, std::size_t b, int largest) {
    const auto side = static_cast<std::size_t>(2 * largest + 1), half = static_cast<std::size_t>(largest);
    // Sums for fy >= 0 only; the others are their mirror images.
    std::vector<double> re((half + 1) * side, 0.0), im = re, cx(side), sx(side);
    for (std::size_t i = 0; i < points.size(); ++i) {
        for (std::size_t f = 0; f < side; ++f) {
            const double angle = -2 * std::numbers::pi * (static_cast<double>(f) - largest) * points[i][a];
            cx[f] = std::cos(angle);
            sx[f] = std::sin(angle);
        }
        for (std::size_t fy = 0; fy <= half; ++fy) {
            const double angle = -2 * std::numbers::pi * static_cast<double>(fy) * points[i][b], c = std::cos(angle), s = std::sin(angle);
            double* r = re.data() + fy * side;
            double* m = im.data() + fy * side;
            for (std::size_t f = 0; f < side; ++f) {
                r[f] += cx[f] * c - sx[f] * s;
                m[f] += cx[f] * s + sx[f] * c;
            }
        }
    }
    Spectrum spectrum{.largest = largest, .power = std::vector<double>(side * side)};
    for (std::size_t fy = 0; fy <= half; ++fy)
        for (std::size_t f = 0; f < side; ++f) {
            const double power = (re[fy * side + f] * re[fy * side + f] + im[fy * side + f] * im[fy * side + f]) / static_cast<double>(points.size());
            spectrum.power[(half + fy) * side + f] = power;
            spectrum.power[(half - fy) * side + (side - 1 - f)] = power;
        }
    spectrum.power[half * side + half] = 0;
    return spectrum;
}

std::vector<double> radial_mean(const Spectrum& spectrum) {
    std::vector<double> sum(static_cast<std::size_t>(spectrum.largest) + 1, 0.0), count = sum;
    for (int fy = -spectrum.largest; fy <= spectrum.largest; ++fy)
        for (int fx = -spectrum.largest; fx <= spectrum.largest; ++fx) {
            const auto k = static_cast<std::size_t>(std::lround(std::hypot(fx, fy)));
            if (k == 0 || k >= sum.size()) continue;
            sum[k] += spectrum.at(fx, fy);
            count[k] += 1;
        }
    std::vector<double> mean;
    for (std::size_t k = 1; k < sum.size(); ++k) mean.push_back(sum[k] / count[k]);
    return mean;
}

}  // namespace koksma
