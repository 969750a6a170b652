// Point-set metrics against values known exactly, and against those of scipy.stats.qmc.discrepancy (double precision).

#include <koksma/measure/point_set.h>
#include <koksma/sampling/error.h>
#include <koksma/sampling/registry.h>

#include <koksma_catch.h>

#include <array>
#include <cmath>
#include <tuple>

using namespace koksma;

namespace {

double inverse(std::uint64_t i, std::uint64_t base) {
    double x = 0, w = 1.0 / static_cast<double>(base);
    for (; i != 0; i /= base, w /= static_cast<double>(base)) x += w * static_cast<double>(i % base);
    return x;
}

/// Rows f(i) for i in [first, first + n).
template <class F>
std::vector<double> rows(std::size_t first, std::size_t n, F f) {
    std::vector<double> all;
    for (std::size_t i = first; i < first + n; ++i)
        for (const double x : f(i)) all.push_back(x);
    return all;
}

/// The first n points of unscrambled Sobol', dimensions [first, first + count).
std::vector<double> sobol(std::size_t n, std::size_t first, std::size_t count) {
    Registry registry;
    register_samplers(registry);
    SamplingPlan plan;
    plan.spp = n;
    plan.layout = plain_layout(std::vector<std::uint8_t>(first + count, 1));
    const auto source = registry.make("sobol:randomize=none")->bind(plan);
    std::vector<SampleId> ids(n);
    for (std::size_t i = 0; i < n; ++i) ids[i].index = i;
    std::vector<float> values(n * (first + count));
    source->fill(ids, plan.layout.slots(), values.data(), n);
    return rows(0, n, [&](std::size_t i) {
        std::vector<double> row;
        for (std::size_t d = first; d < first + count; ++d) row.push_back(static_cast<double>(values[d * n + i]));
        return row;
    });
}

}  // namespace

TEST_CASE("star discrepancies of known sequences are exact in one dimension", "[measure]") {
    const auto van_der_corput = [](std::uint64_t base, std::size_t first, std::size_t n) {
        const auto x = rows(first, n, [&](std::size_t i) { return std::array{inverse(i, base)}; });
        return star_discrepancy({x, 1});
    };
    for (const auto& [n, exact] : {std::pair{1, 1.0}, {2, 0.5}, {3, 0.5}, {4, 0.25}, {5, 7 / 20.0}, {7, 0.25}, {8, 0.125}, {11, 17 / 88.0}, {21, 13 / 112.0}, {64, 1 / 64.0}})
        CHECK(std::abs(van_der_corput(2, 0, static_cast<std::size_t>(n)) - exact) < 1e-12);
    for (const auto& [n, exact] : {std::pair{1, 0.5}, {2, 0.5}, {3, 0.25}, {5, 0.25}, {16, 1 / 16.0}})
        CHECK(std::abs(van_der_corput(2, 1, static_cast<std::size_t>(n)) - exact) < 1e-12);
    for (const auto& [n, exact] : {std::pair{3, 1 / 3.0}, {5, 16 / 45.0}, {16, 31 / 216.0}, {27, 1 / 27.0}})
        CHECK(std::abs(van_der_corput(3, 0, static_cast<std::size_t>(n)) - exact) < 1e-12);
}

namespace {

/// Star discrepancy over all corners of the grid that the points' coordinates and 1 make: exact, n^d boxes.
double star_of_grid(const PointSet& points) {
    const std::size_t n = points.size(), d = points.dimensions;
    double worst = 0;
    std::vector<std::size_t> at(d, 0);
    for (;;) {
        std::vector<double> z(d);
        double volume = 1;
        for (std::size_t k = 0; k < d; ++k) volume *= z[k] = at[k] == n ? 1.0 : points[at[k]][k];
        std::size_t open = 0, closed = 0;
        for (std::size_t i = 0; i < n; ++i) {
            bool in_open = true, in_closed = true;
            for (std::size_t k = 0; k < d; ++k) in_open = in_open && points[i][k] < z[k], in_closed = in_closed && points[i][k] <= z[k];
            open += in_open, closed += in_closed;
        }
        worst = std::max({worst, volume - static_cast<double>(open) / static_cast<double>(n), static_cast<double>(closed) / static_cast<double>(n) - volume});
        std::size_t k = 0;
        while (k < d && at[k] == n) at[k++] = 0;
        if (k == d) return worst;
        ++at[k];
    }
}

}  // namespace

TEST_CASE("bounds of the star discrepancy enclose it, and meet where there is time", "[measure]") {
    for (const std::size_t n : {1u, 7u, 64u, 300u}) {
        const auto points = sobol(n, 1, 2);
        const double exact = star_discrepancy({points, 2});
        double width = 2;
        for (const std::size_t boxes : {0u, 10u, 1000u, 20000u}) {
            const StarBounds b = star_discrepancy_bounds({points, 2}, boxes);
            CAPTURE(n, boxes, b.lower, exact, b.upper);
            CHECK(b.lower <= exact + 1e-15);
            CHECK(exact <= b.upper + 1e-15);
            CHECK(b.upper - b.lower <= width);
            width = b.upper - b.lower;
        }
        CHECK(width < 0.003);
    }
    for (const auto& [n, d] : {std::pair{std::size_t{16}, std::size_t{3}}, {11, 4}, {23, 3}}) {
        const auto points = sobol(n, 0, d);
        const double exact = star_of_grid({points, d});
        for (const std::size_t boxes : {100u, 20000u}) {
            const StarBounds b = star_discrepancy_bounds({points, d}, boxes);
            CAPTURE(n, d, boxes, b.lower, exact, b.upper);
            CHECK(b.lower <= exact + 1e-15);
            CHECK(exact <= b.upper + 1e-15);
        }
    }
    CHECK_THROWS_AS(star_discrepancy_bounds({{}, 3}, 1), Error);
}

TEST_CASE("star discrepancies of known sequences are exact in two dimensions", "[measure]") {
    constexpr std::array<std::size_t, 5> kCounts{4, 8, 16, 32, 64};
    constexpr std::array kHammersley{1 / 2.0, 5 / 16.0, 11 / 64.0, 25 / 256.0, 55 / 1024.0};
    constexpr std::array kHalton{1 / 2.0, 23 / 72.0, 29 / 144.0, 5 / 48.0, 5 / 96.0};
    constexpr std::array kHaltonFrom1{1 / 2.0, 2 / 9.0, 25 / 144.0, 43 / 432.0, 5 / 96.0};
    constexpr std::array kSobol01{7 / 16.0, 5 / 16.0, 11 / 64.0, 23 / 256.0, 55 / 1024.0};
    constexpr std::array kSobol12{1 / 2.0, 15 / 64.0, 9 / 64.0, 23 / 256.0, 111 / 2048.0};
    for (std::size_t k = 0; k < kCounts.size(); ++k) {
        const std::size_t n = kCounts[k];
        INFO(n << " points");
        const auto halton = [](std::size_t i) { return std::array{inverse(i, 2), inverse(i, 3)}; };
        CHECK(std::abs(star_discrepancy({rows(0, n, [n](std::size_t i) { return std::array{static_cast<double>(i) / static_cast<double>(n), inverse(i, 2)}; }), 2}) - kHammersley[k]) < 1e-12);
        CHECK(std::abs(star_discrepancy({rows(0, n, halton), 2}) - kHalton[k]) < 1e-12);
        CHECK(std::abs(star_discrepancy({rows(1, n, halton), 2}) - kHaltonFrom1[k]) < 1e-12);
        CHECK(std::abs(star_discrepancy({sobol(n, 0, 2), 2}) - kSobol01[k]) < 1e-12);
        CHECK(std::abs(star_discrepancy({sobol(n, 1, 2), 2}) - kSobol12[k]) < 1e-12);
    }
    CHECK_THROWS_AS(star_discrepancy({sobol(4, 0, 3), 3}), Error);
}

TEST_CASE("L2 discrepancies agree with scipy's", "[measure]") {
    struct Row {
        std::size_t d, n;
        double centred, wraparound, mixture, star;  // scipy squares all but the last
    };
    constexpr Row kRows[] = {
        {2, 16, 0.0036243862575953134, 0.003968132866753571, 0.0045705371432815944, 0.047766230959700805},
        {2, 64, 0.00024001962608743987, 0.00025360120667361485, 0.00029692260755487254, 0.012869849626468793},
        {2, 256, 1.663160380993567e-05, 2.4205397090248937e-05, 2.283033325722883e-05, 0.0033074703678268075},
        {4, 16, 0.017769377209917003, 0.025595733345440852, 0.03714002443274378, 0.055360908728851244},
        {4, 64, 0.001237796612935771, 0.0025627142481732257, 0.0032715946442536392, 0.014896763517805481},
        {4, 256, 0.00012570491511532111, 0.00027728553837214065, 0.00031864654111402047, 0.005123310002769805},
    };
    for (const Row& row : kRows) {
        const std::vector<double> values = sobol(row.n, 0, row.d);
        const PointSet points{values, row.d};
        INFO(row.d << " dimensions, " << row.n << " points");
        // Sums near 1 cancel to 1e-5: 1e-12 of them is what double leaves.
        CHECK(std::abs(std::pow(centred_discrepancy(points), 2) - row.centred) < 1e-12);
        CHECK(std::abs(std::pow(wraparound_discrepancy(points), 2) - row.wraparound) < 1e-12);
        CHECK(std::abs(std::pow(mixture_discrepancy(points), 2) - row.mixture) < 1e-12);
        CHECK(std::abs(l2_star_discrepancy(points) - row.star) < 1e-10);
    }
}

TEST_CASE("quality parameters of the Sobol' sequence are the known ones", "[measure]") {
    const auto t = [](int m, std::vector<std::size_t> projection) {
        const std::vector<double> values = sobol(std::size_t{1} << m, 0, 10);
        return quality_parameter({values, 10}, projection);
    };
    for (int m = 4; m <= 12; m += 2) CHECK(t(m, {0, 1}) == 0);
    CHECK(t(10, {0}) == 0);
    CHECK(t(10, {1, 7}) == 3);
    CHECK(t(12, {5, 9}) == 4);
    CHECK(t(10, {0, 8}) == 4);
    constexpr std::array kThree{1, 1, 1, 1, 1}, kFour{2, 2, 2, 2, 3}, kFive{2, 2, 3, 3, 3};
    for (int m = 4; m <= 8; ++m) {
        CHECK(t(m, {0, 1, 2}) == kThree[static_cast<std::size_t>(m - 4)]);
        CHECK(t(m, {0, 1, 2, 3}) == kFour[static_cast<std::size_t>(m - 4)]);
        CHECK(t(m, {0, 1, 2, 3, 4}) == kFive[static_cast<std::size_t>(m - 4)]);
    }
    CHECK_THROWS_AS(quality_parameter({std::vector<double>{0.1, 0.2, 0.3}, 1}, std::array<std::size_t, 1>{0}), Error);
}

TEST_CASE("the spectrum of a grid is a grid and that of a net is empty along the axes", "[measure]") {
    const auto grid = rows(0, 64, [](std::size_t i) { return std::array{static_cast<double>(i % 8) / 8, static_cast<double>(i / 8) / 8}; });
    const Spectrum s = power_spectrum({grid, 2}, 0, 1, 16);
    for (int fy = -16; fy <= 16; ++fy)
        for (int fx = -16; fx <= 16; ++fx) {
            const bool peak = fx % 8 == 0 && fy % 8 == 0 && (fx != 0 || fy != 0);
            CHECK(std::abs(s.at(fx, fy) - (peak ? 64 : 0)) < 1e-9);
        }
    const auto net = sobol(256, 0, 2);
    const Spectrum t = power_spectrum({net, 2}, 0, 1, 20);
    for (int f = 1; f <= 20; ++f) CHECK(t.at(f, 0) + t.at(0, f) < 1e-9);
    CHECK(radial_mean(t).size() == 20);
}
