#include <koksma/measure/metrics.h>
#include <koksma/sampling/error.h>
#include <koksma_catch.h>

#include <cmath>
#include <limits>
#include <random>
#include <vector>

using namespace koksma;

namespace {

constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();
constexpr float kInfinity = std::numeric_limits<float>::infinity();

struct Pair {
    std::vector<float> mean, variance;
};

/// The mean of k independent batches about truth, each value with standard deviation sd of its own, and its variance s^2 / k.
Pair batches(const std::vector<double>& truth, const std::vector<double>& sd, int k, std::mt19937_64& g) {
    std::normal_distribution<double> normal;
    Pair p;
    for (std::size_t i = 0; i < truth.size(); ++i) {
        double sum = 0, squares = 0;
        for (int j = 0; j < k; ++j) {
            const double noise = normal(g);
            sum += noise;
            squares += noise * noise;
        }
        p.mean.push_back(static_cast<float>(truth[i] + sd[i] * sum / k));
        p.variance.push_back(static_cast<float>(sd[i] * sd[i] * (squares - sum * sum / k) / (k - 1) / k));
    }
    return p;
}

}  // namespace

TEST_CASE("metrics of two pixels agree with numbers by hand", "[unit][measure]") {
    const float a[] = {1, 2, 3, 0, 0, 0}, b[] = {1, 1, 1, 2, 0, 0};
    const ImageError e = compare_images(a, b);
    CHECK(e.pixels == 2);
    CHECK(e.all_finite());
    CHECK(e.mse == Approx((0 + 1 + 4 + 4) / 6.0));
    CHECK(e.rmse == Approx(std::sqrt(1.5)));
    CHECK(e.mae == Approx((0 + 1 + 2 + 2) / 6.0));
    CHECK(e.smape == Approx((0 + 1 / 3.0 + 2 / 4.0 + 1) / 6.0));
    CHECK(e.max_abs == 2);
    CHECK(e.mean_a[0] == 0.5);
    CHECK(e.mean_a[1] == 1);
    CHECK(e.mean_a[2] == 1.5);
    CHECK(e.mean_b[0] == 1.5);
    CHECK(e.mean_b[1] == 0.5);
    // mean luminance (1 + 2 * 0.212671) / 2; only the first two terms have their denominators 1 + eps, the third 4 + eps
    const double luminance = (1 + 2 * 0.212671) / 2, eps = 0.01 * luminance * luminance;
    CHECK(e.relmse == Approx((1 / (1 + eps) + 4 / (1 + eps) + 4 / (4 + eps)) / 6).epsilon(1e-12));
}

TEST_CASE("an error against a noisy reference is smaller by the reference's variance", "[unit][measure]") {
    const float x[] = {2, 1, 1}, r[] = {1, 1, 1}, v[] = {0.25f, 0.5f, 0};
    const ReferenceError e = compare_to_reference(x, r, v);
    CHECK(e.mse_raw == Approx(1.0 / 3));
    CHECK(e.mse_floor == Approx(0.25));
    CHECK(e.mse == Approx(1.0 / 3 - 0.25));
    CHECK(e.relmse_raw == Approx(1 / 1.01 / 3));
    CHECK(e.relmse_floor == Approx(0.25 / 1.01));
    CHECK(e.relmse == Approx((1.0 / 3 - 0.25) / 1.01));
    CHECK(compare_to_reference(r, r, v).mse == Approx(-0.25));  // negative where it must be, never clamped
    const ReferenceError plain = compare_to_reference(x, r, {});
    CHECK(plain.mse == plain.mse_raw);
    CHECK(plain.relmse == plain.relmse_raw);
    CHECK(plain.mse_floor == 0);
    CHECK(plain.mse_raw == Approx(compare_images(x, r).mse));
    CHECK(plain.relmse_raw == Approx(compare_images(x, r).relmse));
}

TEST_CASE("a mask leaves pixels out, and the denominators as they were", "[unit][measure]") {
    const float x[] = {2, 1, 1, 5, 5, 5}, r[] = {1, 1, 1, 9, 9, 9}, v[] = {0.25f, 0.5f, 0, 1, 1, 1};
    const unsigned char skip[] = {0, 1};
    const ReferenceError e = compare_to_reference(x, r, v, skip);
    CHECK(e.pixels == 1);
    CHECK(e.mse == Approx((1 - 0.75) / 3));
    CHECK(e.mae == Approx(1.0 / 3));
    CHECK(e.smape == Approx(1.0 / 9));
    CHECK(e.relmse_raw == Approx(1 / (1 + 0.01 * 25) / 3));  // the mean luminance is 5
    const unsigned char all[] = {1, 1};
    CHECK(std::isnan(compare_to_reference(x, r, v, all).mse));
    CHECK_THROWS_AS(compare_to_reference(x, r, v, std::span(skip, 1)), Error);
}

TEST_CASE("the correction is unbiased for MSE and nearly so for relMSE", "[unit][measure]") {
    // 100 pixels; the reference is as noisy as the image, so the raw error is twice the true one.
    constexpr std::size_t kValues = 300;
    std::mt19937_64 g(5);
    std::normal_distribution<double> normal;
    std::vector<double> truth(kValues), sd(kValues);
    for (std::size_t i = 0; i < kValues; ++i) {
        truth[i] = 0.5 + static_cast<double>(i % 7);
        sd[i] = 0.05 * truth[i];
    }
    std::vector<float> exact(truth.begin(), truth.end());
    constexpr int kRepeats = 400, kBatches = 4;
    double mse[3] = {}, relmse[3] = {}, squares[2] = {};  // true, corrected, raw; squared differences
    for (int n = 0; n < kRepeats; ++n) {
        std::vector<float> image(kValues);
        for (std::size_t i = 0; i < kValues; ++i) image[i] = static_cast<float>(truth[i] + sd[i] / std::sqrt(double{kBatches}) * normal(g));
        const Pair reference = batches(truth, sd, kBatches, g);
        const ReferenceError against_truth = compare_to_reference(image, exact, {});
        const ReferenceError e = compare_to_reference(image, reference.mean, reference.variance);
        const double t[] = {against_truth.mse, e.mse, e.mse_raw}, q[] = {against_truth.relmse, e.relmse, e.relmse_raw};
        for (int k = 0; k < 3; ++k) {
            mse[k] += t[k] / kRepeats;
            relmse[k] += q[k] / kRepeats;
        }
        squares[0] += (t[1] - t[0]) * (t[1] - t[0]);
        squares[1] += (q[1] - q[0]) * (q[1] - q[0]);
    }
    const double mse_error = std::sqrt(squares[0]) / kRepeats, relmse_error = std::sqrt(squares[1]) / kRepeats;
    CAPTURE(mse[0], mse[1], mse[2], mse_error, relmse[0], relmse[1], relmse[2], relmse_error);
    CHECK(std::abs(mse[1] - mse[0]) < 5 * mse_error);
    CHECK(mse_error < 0.02 * mse[0]);  // so that the line above means something
    CHECK(mse[2] == Approx(2 * mse[0]).epsilon(0.05));
    CHECK(std::abs(relmse[1] - relmse[0]) < 5 * relmse_error + 0.01 * relmse[0]);  // denominators have (2.5 %)^2 relative bias
    CHECK(relmse[2] == Approx(2 * relmse[0]).epsilon(0.05));
}

TEST_CASE("pixels that are not finite are left out of every metric and counted", "[unit][measure]") {
    const float a[] = {1, 1, 1, kNaN, 1, 1, 5, 5, 5, 3, 3, 3}, b[] = {1, 1, 2, 1, 1, 1, 1, kInfinity, 1, 3, 3, 3};
    const ImageError e = compare_images(a, b);
    CHECK(e.non_finite_a == 1);
    CHECK(e.non_finite_b == 1);
    CHECK_FALSE(e.all_finite());
    CHECK(e.pixels == 2);
    CHECK(e.mse == Approx(1.0 / 6));
    CHECK(e.max_abs == 1);
    CHECK(e.mean_a[0] == 2);
    const float v[] = {0, 0, 0, 0, 0, 0, 0, 0, 0, 0, kNaN, 0};
    const ReferenceError r = compare_to_reference(a, b, v);
    CHECK(r.non_finite_image == 1);
    CHECK(r.non_finite_reference == 2);
    CHECK(r.pixels == 1);
    CHECK(r.mse == Approx(1.0 / 3));
    const float all[] = {kNaN, 0, 0};
    const ImageError none = compare_images(all, all);
    CHECK(none.pixels == 0);
    CHECK(std::isnan(none.mse));
    CHECK(std::isnan(none.max_abs));
}

TEST_CASE("a black reference has no relative error", "[unit][measure]") {
    const float black[] = {0, 0, 0}, grey[] = {1, 1, 1};
    CHECK(std::isnan(compare_images(grey, black).relmse));
    CHECK(compare_images(grey, black).mse == 1);
    CHECK(std::isnan(compare_to_reference(grey, black, {}).relmse));
    CHECK(std::isfinite(compare_images(black, grey).relmse));
}

TEST_CASE("images of different or impossible sizes are errors that say so", "[unit][measure]") {
    const std::vector<float> six(6), three(3), four(4);
    CHECK_THROWS_AS(compare_images(six, three), Error);
    CHECK_THROWS_AS(compare_images({}, {}), Error);
    CHECK_THROWS_AS(compare_images(four, four), Error);
    CHECK_THROWS_AS(compare_to_reference(six, six, three), Error);
    CHECK_THROWS_AS(agreement(six, six, six, six, 3, 1), Error);
    CHECK_THROWS_AS(agreement(six, {}, six, {}, 2, 1), Error);
    CHECK_THROWS_AS(agreement(six, six, six, three, 2, 1), Error);
    CHECK_THROWS_AS(agreement({}, {}, {}, {}, 0, 0), Error);
    CHECK_NOTHROW(agreement(six, {}, six, six, 2, 1));
    try {
        (void)compare_images(six, three);
    } catch (const Error& e) {
        CHECK(std::string(e.what()).find("3 values") != std::string::npos);
        CHECK(std::string(e.what()).find("expected 6") != std::string::npos);
    }
}

TEST_CASE("agreement of a block agrees with numbers by hand", "[unit][measure]") {
    // 9 x 1 pixels: a block of 8 and a block of 1
    std::vector<float> a(27, 1), b(27, 1), va(27, 0.01f), vb(27, 0.03f);
    for (std::size_t p = 0; p < 8; ++p) a[3 * p] = 1.1f;  // red of the first block
    b[25] = 2;                                            // green of the last pixel
    const Agreement g = agreement(a, va, b, vb, 9, 1);
    CHECK(g.blocks == 2);
    const double red = 0.8 / std::sqrt(8 * 0.04), green = 1 / 0.2;
    CHECK(g.max_block_z == Approx(green).epsilon(1e-5));
    CHECK(g.max_pixel_z == Approx(green).epsilon(1e-5));
    CHECK(g.rms_z == Approx(std::sqrt((red * red + green * green) / 6)).epsilon(1e-5));
    CHECK(g.fraction_beyond_3 == Approx(1.0 / 6));
    CHECK(g.global_z[0] == Approx(0.8 / std::sqrt(9 * 0.04)).epsilon(1e-5));
    CHECK(g.global_z[1] == Approx(-1 / std::sqrt(9 * 0.04)).epsilon(1e-5));
    CHECK(g.global_z[2] == 0);
}

TEST_CASE("two halves of one truth agree and a bias of 2 percent shows in the whole before it shows in a block", "[unit][measure]") {
    constexpr int kWidth = 50, kHeight = 41;  // not multiples of 8
    std::mt19937_64 g(11);
    std::vector<double> truth(std::size_t{kWidth} * kHeight * 3), sd(truth.size());
    for (std::size_t i = 0; i < truth.size(); ++i) {
        truth[i] = 1 + static_cast<double>(i % 5);
        sd[i] = 0.2 * truth[i];
    }
    const Pair a = batches(truth, sd, 8, g), b = batches(truth, sd, 8, g);
    const Agreement same = agreement(a.mean, a.variance, b.mean, b.variance, kWidth, kHeight);
    CHECK(same.blocks == 7 * 6);
    CHECK(same.rms_z == Approx(1).margin(0.2));  // 126 values: sd 0.06
    CHECK(same.max_block_z < 4.5);               // 126 tries at 4.5: 1e-3
    CHECK(same.fraction_beyond_3 < 0.03);
    for (const double z : same.global_z) CHECK(std::abs(z) < 4);
    CHECK(same.non_finite == 0);
    Pair biased = b;
    for (float& v : biased.mean) v *= 1.02f;  // 8 standard errors of the mean image, 1.4 of a block
    const Agreement off = agreement(a.mean, a.variance, biased.mean, biased.variance, kWidth, kHeight);
    for (const double z : off.global_z) CHECK(z < -4);
    CHECK(off.max_block_z < 6);
    // variances a quarter of the true ones show as an rms z of 2
    Pair sure_a = a, sure_b = b;
    for (float& v : sure_a.variance) v /= 4;
    for (float& v : sure_b.variance) v /= 4;
    const Agreement sure = agreement(sure_a.mean, sure_a.variance, sure_b.mean, sure_b.variance, kWidth, kHeight);
    CHECK(sure.rms_z == Approx(2 * same.rms_z).epsilon(1e-5));
}

TEST_CASE("agreement counts pixels that are not finite and leaves black ones untested", "[unit][measure]") {
    std::vector<float> a(8 * 16 * 3, 0), v(a.size(), 0);
    const Agreement black = agreement(a, v, a, v, 16, 8);
    CHECK(black.blocks == 0);
    CHECK(black.rms_z == 0);
    std::vector<float> b = a;
    b[0] = kNaN;
    b[3] = 1e-3f;  // a difference without any variance to explain it
    const Agreement off = agreement(a, v, b, v, 16, 8);
    CHECK(off.non_finite == 1);
    CHECK(off.blocks == 1);
    CHECK(off.max_block_z > 1e6);
    // a directly seen emitter, exact but for the rounding of float
    std::vector<float> c(a.size(), 17.1f), d(a.size(), std::nextafter(17.1f, 18.0f));
    CHECK(agreement(c, v, d, v, 16, 8).max_pixel_z < 3.5);
    CHECK(agreement(c, v, d, v, 16, 8).max_block_z < 3.5);
}
