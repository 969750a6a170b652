#include <koksma/measure/metrics.h>
#include <koksma/sampling/error.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <string>

namespace koksma {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

void check_sizes(std::size_t a, std::size_t b, const char* name_b) {
    if (a == 0 || a % 3 != 0)
        throw Error("image metrics: found " + std::to_string(a) + " values, expected height * width * 3 and more than none");
    if (a != b)
        throw Error(std::string("image metrics: found ") + std::to_string(b) + " values in the " + name_b + ", expected " +
                    std::to_string(a) + " as in the image");
}

bool finite(std::span<const float> image, std::size_t pixel) {
    return std::isfinite(image[pixel]) && std::isfinite(image[pixel + 1]) && std::isfinite(image[pixel + 2]);
}

double symmetric(double a, double b) {
    const double size = std::abs(a) + std::abs(b);
    return size > 0 ? std::abs(a - b) / size : 0;
}

/// eps of relMSE: from all finite pixels of the reference, whatever it is compared with. Of a black one NaN, and so is relMSE.
double relative_floor(std::span<const float> reference) {
    double sum = 0, n = 0;
    for (std::size_t p = 0; p < reference.size(); p += 3) {
        if (!finite(reference, p)) continue;
        for (std::size_t c = 0; c < 3; ++c) sum += kLuminance[c] * static_cast<double>(reference[p + c]);
        ++n;
    }
    const double mean = n > 0 ? sum / n : kNaN;
    return mean != 0 ? kRelativeFloor * mean * mean : kNaN;
}

}  // namespace

ImageError compare_images(std::span<const float> a, std::span<const float> b) {
    check_sizes(a.size(), b.size(), "second image");
    const double eps = relative_floor(b);
    ImageError e;
    for (std::size_t p = 0; p < a.size(); p += 3) {
        const bool finite_a = finite(a, p), finite_b = finite(b, p);
        e.non_finite_a += !finite_a;
        e.non_finite_b += !finite_b;
        if (!finite_a || !finite_b) continue;
        ++e.pixels;
        for (std::size_t c = 0; c < 3; ++c) {
            const double x = a[p + c], r = b[p + c], d = x - r;
            e.mse += d * d;
            e.relmse += d * d / (r * r + eps);
            e.mae += std::abs(d);
            e.smape += symmetric(x, r);
            e.max_abs = std::max(e.max_abs, std::abs(d));
            e.mean_a[c] += x;
            e.mean_b[c] += r;
        }
    }
    const double pixels = e.pixels > 0 ? static_cast<double>(e.pixels) : kNaN;  // none makes every mean NaN
    e.mse /= 3 * pixels;
    e.rmse = std::sqrt(e.mse);
    e.relmse /= 3 * pixels;
    e.mae /= 3 * pixels;
    e.smape /= 3 * pixels;
    if (e.pixels == 0) e.max_abs = kNaN;
    for (std::size_t c = 0; c < 3; ++c) {
        e.mean_a[c] /= pixels;
        e.mean_b[c] /= pixels;
    }
    return e;
}

ReferenceError compare_to_reference(std::span<const float> image, std::span<const float> reference_mean,
                                    std::span<const float> reference_variance_of_mean, std::span<const unsigned char> skip) {
    check_sizes(image.size(), reference_mean.size(), "reference");
    const bool corrected = !reference_variance_of_mean.empty();
    if (corrected) check_sizes(image.size(), reference_variance_of_mean.size(), "variance of the reference");
    if (!skip.empty()) check_sizes(image.size(), 3 * skip.size(), "mask, times three,");
    const double eps = relative_floor(reference_mean);
    ReferenceError e;
    for (std::size_t p = 0; p < image.size(); p += 3) {
        if (!skip.empty() && skip[p / 3] != 0) continue;
        const bool finite_image = finite(image, p);
        const bool finite_reference = finite(reference_mean, p) && (!corrected || finite(reference_variance_of_mean, p));
        e.non_finite_image += !finite_image;
        e.non_finite_reference += !finite_reference;
        if (!finite_image || !finite_reference) continue;
        ++e.pixels;
        for (std::size_t c = 0; c < 3; ++c) {
            const double r = reference_mean[p + c], d = static_cast<double>(image[p + c]) - r;
            const double denominator = r * r + eps;
            const double variance = corrected ? static_cast<double>(reference_variance_of_mean[p + c]) : 0;
            e.mse_raw += d * d;
            e.relmse_raw += d * d / denominator;
            e.mse_floor += variance;
            e.relmse_floor += variance / denominator;
            e.mae += std::abs(d);
            e.smape += symmetric(static_cast<double>(image[p + c]), r);
        }
    }
    const double n = e.pixels > 0 ? 3 * static_cast<double>(e.pixels) : kNaN;  // none makes every mean NaN
    e.mse_raw /= n;
    e.mse_floor /= n;
    e.mae /= n;
    e.smape /= n;
    e.mse = e.mse_raw - e.mse_floor;
    e.relmse_raw /= n;
    e.relmse_floor /= n;
    e.relmse = e.relmse_raw - e.relmse_floor;
    return e;
}

}  // namespace koksma
