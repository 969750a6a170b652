#pragma once
// Errors of images: linear RGB floats of shape (height, width, 3), sums in double, metrics on radiance and never on display values.

#include <koksma/measure/agreement.h>

#include <cstdint>
#include <span>

namespace koksma {

/// Luminance of linear Rec. 709 RGB. Source: ITU-R BT.709, as pbrt and Mitsuba write it.
inline constexpr double kLuminance[3] = {0.212671, 0.715160, 0.072169};

/// relMSE divides by r^2 + kRelativeFloor * (mean luminance of the reference)^2, so that black pixels do not rule it.
inline constexpr double kRelativeFloor = 0.01;

/// Two images. A pixel that is not finite in either is left out of every number here and counted.
struct ImageError {
    double mse = 0;     ///< mean over pixels and channels of (a - b)^2
    double rmse = 0;    ///< its root
    double relmse = 0;  ///< mean of (a - b)^2 / (b^2 + eps), b the reference; NaN for a black reference
    double mae = 0;     ///< mean of |a - b|
    double smape = 0;   ///< mean of |a - b| / (|a| + |b|), 0 where both are 0: 0 to 1, half of what those call SMAPE who halve the denominator
    double max_abs = 0;
    double mean_a[3] = {}, mean_b[3] = {};
    std::int64_t pixels = 0;        ///< compared
    std::int64_t non_finite_a = 0;  ///< pixels with a NaN or an infinity
    std::int64_t non_finite_b = 0;
    [[nodiscard]] bool all_finite() const noexcept { return non_finite_a == 0 && non_finite_b == 0; }
};

/// A render against a reference that knows its own error.
struct ReferenceError {
    double mse_raw = 0;       ///< against the reference as it is
    double mse = 0;           ///< minus the reference's variance: unbiased for the error against the truth; may be negative
    double relmse_raw = 0;
    double relmse = 0;        ///< corrected likewise, with the denominators of the reference
    double mse_floor = 0;     ///< what was subtracted: mean variance of the reference mean
    double relmse_floor = 0;  ///< mean of variance / (r^2 + eps)
    double mae = 0;           ///< as in ImageError, and like smape not corrected: against the reference as it is
    double smape = 0;
    std::int64_t pixels = 0;
    std::int64_t non_finite_image = 0;      ///< pixels with a NaN or an infinity
    std::int64_t non_finite_reference = 0;  ///< in its mean or its variance
    [[nodiscard]] bool all_finite() const noexcept { return non_finite_image == 0 && non_finite_reference == 0; }
};

/// Compares a with b; b is the reference of relmse.
/// @throws  Error if the sizes differ, are 0 or are no multiple of 3
[[nodiscard]] ImageError compare_images(std::span<const float> a, std::span<const float> b);

/// Errors of one replicate against a reference independent of it, corrected for the reference's variance.
/// @param  reference_mean              r, same shape
/// @param  reference_variance_of_mean  s^2 / K over K independent batches, same shape, or empty: no correction
/// @param  skip                        pixels that are not 0 here are left out (but eps of relMSE is that of the whole reference); empty: none
/// @throws                             Error if the sizes differ, are 0 or are no multiple of 3
[[nodiscard]] ReferenceError compare_to_reference(std::span<const float> image, std::span<const float> reference_mean,
                                                  std::span<const float> reference_variance_of_mean, std::span<const unsigned char> skip = {});

}  // namespace koksma
