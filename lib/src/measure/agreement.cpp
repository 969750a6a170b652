#include <koksma/measure/agreement.h>
#include <koksma/sampling/error.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>

namespace koksma {
namespace {

constexpr int kBlock = 8;  // pixels a side

/// A difference of sums and what is known of its error.
struct Difference {
    double sum = 0, variance = 0;
    double rounding = 0;  ///< standard deviation; added up as it is: equal constants are rounded equally, as a lamp's pixels are
    [[nodiscard]] double total_variance() const noexcept { return variance + rounding * rounding; }
    [[nodiscard]] double z() const noexcept { return total_variance() > 0 ? sum / std::sqrt(total_variance()) : 0; }
    void operator+=(const Difference& d) noexcept {
        sum += d.sum;
        variance += d.variance;
        rounding += d.rounding;
    }
};

struct Images {
    std::span<const float> mean_a, var_a, mean_b, var_b;

    [[nodiscard]] bool finite(std::size_t pixel) const {
        for (const std::span<const float> image : {mean_a, var_a, mean_b, var_b})
            for (std::size_t c = 0; c < 3; ++c)
                if (!image.empty() && !std::isfinite(image[pixel + c])) return false;
        return true;
    }
    [[nodiscard]] Difference at(std::size_t i) const {
        const double a = mean_a[i], b = mean_b[i];
        // A mean stored as float is rounded by up to half an ulp, 2^-24 of its size: uniform, so a third of the square.
        return {a - b, (var_a.empty() ? 0.0 : double{var_a[i]}) + (var_b.empty() ? 0.0 : double{var_b[i]}),
                0x1p-24 * std::sqrt((a * a + b * b) / 3)};
    }
};

void check_sizes(const Images& images, int width, int height) {
    const bool positive = width > 0 && height > 0;
    const std::size_t expected = positive ? std::size_t{3} * static_cast<std::size_t>(width) * static_cast<std::size_t>(height) : 0;
    const auto check = [&](std::span<const float> image, const char* name, bool may_be_empty) {
        if (expected == 0 || (image.size() != expected && !(may_be_empty && image.empty())))
            throw Error(std::string("agreement: found ") + std::to_string(image.size()) + " values in " + name + ", expected " +
                        std::to_string(height) + " x " + std::to_string(width) + " x 3");
    };
    check(images.mean_a, "mean_a", false);
    check(images.mean_b, "mean_b", false);
    check(images.var_a, "var_a", true);
    check(images.var_b, "var_b", true);
    if (images.var_a.empty() && images.var_b.empty()) throw Error("agreement: both variances are empty, expected at least one");
}

}  // namespace

Agreement agreement(std::span<const float> mean_a, std::span<const float> var_a, std::span<const float> mean_b,
                    std::span<const float> var_b, int width, int height) {
    const Images images{mean_a, var_a, mean_b, var_b};
    check_sizes(images, width, height);
    Agreement r;
    Difference total[3];
    double squares = 0, beyond = 0, tested = 0;
    for (int y0 = 0; y0 < height; y0 += kBlock)
        for (int x0 = 0; x0 < width; x0 += kBlock) {
            Difference block[3];
            for (int y = y0; y < std::min(y0 + kBlock, height); ++y)
                for (int x = x0; x < std::min(x0 + kBlock, width); ++x) {
                    const std::size_t p = 3 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x));
                    if (!images.finite(p)) {
                        ++r.non_finite;
                        continue;
                    }
                    for (std::size_t c = 0; c < 3; ++c) {
                        const Difference d = images.at(p + c);
                        r.max_pixel_z = std::max(r.max_pixel_z, std::abs(d.z()));
                        block[c] += d;
                    }
                }
            bool used = false;
            for (int c = 0; c < 3; ++c) {
                total[c] += block[c];
                if (!(block[c].total_variance() > 0)) continue;
                const double z = std::abs(block[c].z());
                used = true;
                ++tested;
                squares += z * z;
                beyond += z > 3;
                r.max_block_z = std::max(r.max_block_z, z);
            }
            r.blocks += used;
        }
    if (tested > 0) {
        r.rms_z = std::sqrt(squares / tested);
        r.fraction_beyond_3 = beyond / tested;
    }
    for (int c = 0; c < 3; ++c) r.global_z[c] = total[c].z();
    return r;
}

}  // namespace koksma
