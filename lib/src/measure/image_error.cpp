#include <koksma/measure/image_error.h>
#include <koksma/measure/metrics.h>
#include <koksma/sampling/error.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <cstddef>
#include <limits>
#include <string>

namespace koksma {
namespace {

double luminance_of(std::span<const float> rgb, std::size_t pixel) {
    double y = 0;
    for (std::size_t c = 0; c < 3; ++c) y += kLuminance[c] * static_cast<double>(rgb[3 * pixel + c]);
    return y;
}

void check(const std::vector<std::vector<float>>& images, std::size_t size, std::size_t least) {
    if (images.size() < least) throw Error("image errors: found " + std::to_string(images.size()) + " replicates, expected " + std::to_string(least) + " or more");
    for (const std::vector<float>& image : images)
        if (image.size() != size) throw Error("image errors: found a replicate of " + std::to_string(image.size()) + " values, expected " + std::to_string(size));
}

/// |DFT|^2 of a real image, by rows and then columns.
std::vector<double> power(const std::vector<double>& image, std::size_t width, std::size_t height) {
    using Complex = std::complex<double>;
    const auto transform = [](const Complex* in, Complex* out, std::size_t n, std::size_t stride, const std::vector<Complex>& roots) {
        for (std::size_t k = 0; k < n; ++k) {
            Complex sum = 0;
            for (std::size_t x = 0; x < n; ++x) sum += in[x * stride] * roots[k * x % n];
            out[k * stride] = sum;
        }
    };
    const auto roots = [](std::size_t n) {
        std::vector<Complex> r;
        for (std::size_t k = 0; k < n; ++k) r.push_back(std::polar(1.0, -2 * 3.14159265358979323846 * static_cast<double>(k) / static_cast<double>(n)));
        return r;
    };
    std::vector<Complex> a(image.begin(), image.end()), b(a.size());
    const std::vector<Complex> along_x = roots(width), along_y = roots(height);
    for (std::size_t y = 0; y < height; ++y) transform(&a[y * width], &b[y * width], width, 1, along_x);
    for (std::size_t x = 0; x < width; ++x) transform(&b[x], &a[x], height, width, along_y);
    std::vector<double> out;
    for (const Complex& z : a) out.push_back(std::norm(z) / static_cast<double>(a.size()));
    return out;
}

/// One channel, filtered.
std::vector<double> blurred(const std::vector<double>& in, int width, int height, const std::vector<double>& taps) {
    const int radius = static_cast<int>(taps.size() / 2);
    std::vector<double> rows(in.size()), out(in.size());
    const auto at = [&](int x, int y) { return static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x); };
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x)
            for (int k = -radius; k <= radius; ++k) rows[at(x, y)] += taps[static_cast<std::size_t>(k + radius)] * in[at(std::clamp(x + k, 0, width - 1), y)];
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x)
            for (int k = -radius; k <= radius; ++k) out[at(x, y)] += taps[static_cast<std::size_t>(k + radius)] * rows[at(x, std::clamp(y + k, 0, height - 1))];
    return out;
}

}  // namespace

PixelStatistics pixel_statistics(const std::vector<std::vector<float>>& images, std::span<const float> reference, std::span<const float> reference_variance) {
    check(images, reference.size(), 2);
    if (reference_variance.size() != reference.size()) throw Error("image errors: the reference and its variance differ in size");
    const auto n = static_cast<double>(images.size());
    PixelStatistics s;
    for (std::size_t p = 0; p < reference.size() / 3; ++p) {
        const double r = luminance_of(reference, p);
        double sum = 0, squares = 0, noise = 0;
        for (const std::vector<float>& image : images) sum += luminance_of(image, p) - r;
        const double mean = sum / n;
        double around = 0;
        for (const std::vector<float>& image : images) {
            const double d = luminance_of(image, p) - r;
            squares += d * d;
            around += (d - mean) * (d - mean);
        }
        for (std::size_t c = 0; c < 3; ++c) noise += kLuminance[c] * kLuminance[c] * static_cast<double>(reference_variance[3 * p + c]);
        const double variance = around / (n - 1), error = std::sqrt(variance / n + noise);
        s.mse.push_back(squares / n);
        s.variance.push_back(variance);
        s.bias_z.push_back(variance > 0 ? mean / error : std::numeric_limits<double>::quiet_NaN());
    }
    return s;
}

double median_pixel_gain(std::span<const double> mse_a, std::span<const double> mse_b) {
    if (mse_a.size() != mse_b.size()) throw Error("image errors: maps differ in size");
    std::vector<double> ratios;
    for (std::size_t i = 0; i < mse_a.size(); ++i)
        if (mse_a[i] > 0 || mse_b[i] > 0) ratios.push_back(mse_a[i] > 0 ? mse_b[i] / mse_a[i] : std::numeric_limits<double>::infinity());
    if (ratios.empty()) return std::numeric_limits<double>::quiet_NaN();
    const auto middle = ratios.begin() + static_cast<std::ptrdiff_t>(ratios.size() / 2);
    std::nth_element(ratios.begin(), middle, ratios.end());
    return *middle;
}

std::vector<double> error_spectrum(const std::vector<std::vector<float>>& images, std::span<const float> reference, int width, int height) {
    check(images, reference.size(), 1);
    const auto w = static_cast<std::size_t>(width), h = static_cast<std::size_t>(height);
    if (3 * w * h != reference.size()) throw Error("image errors: the reference is not of the given width and height");
    const int side = std::min(width, height);
    std::vector<double> sums(static_cast<std::size_t>(side / 2 + 1)), counts(sums.size());
    std::vector<double> error(w * h);
    for (const std::vector<float>& image : images) {
        for (std::size_t p = 0; p < error.size(); ++p) error[p] = luminance_of(image, p) - luminance_of(reference, p);
        const std::vector<double> spectrum = power(error, w, h);
        for (int y = 0; y < height; ++y)
            for (int x = 0; x < width; ++x) {
                const double fx = static_cast<double>(std::min(x, width - x)) / width, fy = static_cast<double>(std::min(y, height - y)) / height;
                const auto ring = static_cast<std::size_t>(std::lround(std::sqrt(fx * fx + fy * fy) * side));
                if (ring >= sums.size()) continue;
                sums[ring] += spectrum[static_cast<std::size_t>(y) * w + static_cast<std::size_t>(x)];
                ++counts[ring];
            }
    }
    for (std::size_t i = 0; i < sums.size(); ++i) sums[i] /= counts[i];
    return sums;
}

double blurred_mse(std::span<const float> image, std::span<const float> reference, int width, int height, double sigma) {
    if (image.size() != reference.size() || image.size() != std::size_t{3} * static_cast<std::size_t>(width) * static_cast<std::size_t>(height))
        throw Error("image errors: sizes differ");
    const int radius = static_cast<int>(std::ceil(4 * sigma));
    std::vector<double> taps;
    double total = 0;
    for (int k = -radius; k <= radius; ++k) {
        taps.push_back(sigma > 0 ? std::exp(-0.5 * k * k / (sigma * sigma)) : 1);
        total += taps.back();
    }
    for (double& t : taps) t /= total;
    double sum = 0;
    for (std::size_t c = 0; c < 3; ++c) {
        std::vector<double> error;
        for (std::size_t i = c; i < image.size(); i += 3) error.push_back(static_cast<double>(image[i]) - static_cast<double>(reference[i]));
        for (const double e : blurred(error, width, height, taps)) sum += e * e;
    }
    return sum / static_cast<double>(image.size());
}

}  // namespace koksma
