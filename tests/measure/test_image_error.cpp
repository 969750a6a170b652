#include <koksma/measure/image_error.h>
#include <koksma/measure/metrics.h>
#include <koksma/sampling/error.h>
#include <koksma_catch.h>

#include <cmath>
#include <random>
#include <vector>

using namespace koksma;

namespace {

/// A grey image of white noise about 1.
std::vector<float> white(std::size_t pixels, double sd, std::mt19937_64& g) {
    std::normal_distribution<double> normal(0, sd);
    std::vector<float> out;
    for (std::size_t i = 0; i < pixels; ++i) {
        const auto v = static_cast<float>(1 + normal(g));
        out.insert(out.end(), {v, v, v});
    }
    return out;
}

}  // namespace

TEST_CASE("white noise has a flat error spectrum, as high as its variance", "[unit][measure]") {
    std::mt19937_64 g(3);
    const int width = 24, height = 16;
    std::vector<std::vector<float>> images;
    for (int i = 0; i < 200; ++i) images.push_back(white(width * height, 0.1, g));
    const std::vector<float> reference(3 * width * height, 1.0f);
    const std::vector<double> spectrum = error_spectrum(images, reference, width, height);
    REQUIRE(spectrum.size() == 9);
    for (const double p : spectrum) CHECK(p == Approx(0.01).epsilon(0.3));  // ring 0 has one term: sd 0.1 over 200 replicates
}

TEST_CASE("a wave has its power in its ring", "[unit][measure]") {
    const int n = 16;
    std::vector<float> wave, reference(3 * n * n, 1.0f);
    for (int i = 0; i < n * n; ++i) {
        const auto v = static_cast<float>(1 + 0.1 * std::cos(2 * 3.14159265358979 * 4 * (i % n) / n));
        wave.insert(wave.end(), {v, v, v});
    }
    const std::vector<double> spectrum = error_spectrum({wave}, reference, n, n);
    for (std::size_t ring = 0; ring < spectrum.size(); ++ring)
        if (ring == 4)
            CHECK(spectrum[ring] > 0.01);
        else
            CHECK(spectrum[ring] < 1e-9);
}

TEST_CASE("a Gaussian filter takes white noise by 4 pi sigma^2 and a constant error not at all", "[unit][measure]") {
    std::mt19937_64 g(5);
    const int n = 48;
    const std::vector<float> reference(3 * n * n, 1.0f), shifted(3 * n * n, 1.5f);
    const std::vector<float> noise = white(n * n, 0.1, g);
    CHECK(blurred_mse(noise, reference, n, n, 0) == Approx(compare_images(noise, reference).mse));
    CHECK(blurred_mse(noise, reference, n, n, 2) == Approx(0.01 / (4 * 3.14159 * 4)).epsilon(0.35));  // borders and one image: some 15 %
    CHECK(blurred_mse(shifted, reference, n, n, 2) == Approx(0.25));
}

TEST_CASE("pixel statistics of unbiased replicates have z of one, and a biased pixel stands out", "[unit][measure]") {
    std::mt19937_64 g(7);
    const std::size_t n = 400;
    std::vector<std::vector<float>> images;
    for (int i = 0; i < 16; ++i) {
        images.push_back(white(n, 0.1, g));
        for (std::size_t c = 0; c < 3; ++c) images.back()[c] += 0.5f;
    }
    const std::vector<float> reference(3 * n, 1.0f), exact(3 * n, 0.0f);
    const PixelStatistics s = pixel_statistics(images, reference, exact);
    double z2 = 0, variance = 0;
    for (std::size_t p = 1; p < n; ++p) {
        z2 += s.bias_z[p] * s.bias_z[p] / (n - 1);
        variance += s.variance[p] / (n - 1);
    }
    CHECK(z2 == Approx(15.0 / 13).epsilon(0.2));  // of t with 15 degrees
    CHECK(variance == Approx(0.01).epsilon(0.1));
    CHECK(s.bias_z[0] > 10);
    CHECK(s.mse[0] == Approx(0.26).epsilon(0.2));
    CHECK_THROWS_AS(pixel_statistics({images[0]}, reference, exact), Error);
}

TEST_CASE("the median pixel gain is not ruled by one pixel", "[unit][measure]") {
    const double a[] = {1, 1, 1, 1000, 0}, b[] = {2, 2, 2, 1, 0};
    CHECK(median_pixel_gain(a, b) == 2);
    CHECK(std::isnan(median_pixel_gain(std::vector<double>{0.0}, std::vector<double>{0.0})));
}
