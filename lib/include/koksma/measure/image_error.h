#pragma once
// Where in the image the error is, and at which frequencies: maps and spectra over replicates, errors after a blur.

#include <span>
#include <vector>

namespace koksma {

/// What replicates say of each pixel; maps of shape (height, width), of luminance.
struct PixelStatistics {
    std::vector<double> mse;       ///< mean over replicates of the squared error against the reference
    std::vector<double> variance;  ///< of one replicate, unbiased
    std::vector<double> bias_z;    ///< (mean - reference) over its standard error, which holds the reference's; t-like with R - 1 degrees; NaN where all replicates agree: few that found nothing say nothing
};
/// @param  images              replicates, each of shape (height, width, 3)
/// @param  reference_variance  of the reference's mean
/// @throws Error with fewer than two replicates, or if sizes differ
[[nodiscard]] PixelStatistics pixel_statistics(const std::vector<std::vector<float>>& images, std::span<const float> reference, std::span<const float> reference_variance);

/// Median over pixels of (mse of b) / (mse of a): what a typical pixel gains by A, where the ratio of means is ruled by the worst pixels.
/// Pixels where neither errs are left out; NaN if none is left.
[[nodiscard]] double median_pixel_gain(std::span<const double> mse_a, std::span<const double> mse_b);

/// Power of the luminance error by frequency, mean over replicates, in rings of width 1 / min(width, height) cycles a pixel, up to 0.5. Scaled so that
/// white noise has a flat spectrum whose height is its variance. Ring 0 (the mean error alone) is first.
/// @note  By plain sums over rows and columns: O(n^3) for n x n pixels.
[[nodiscard]] std::vector<double> error_spectrum(const std::vector<std::vector<float>>& images, std::span<const float> reference, int width, int height);

/// MSE over all channels after both images are filtered by a Gaussian, border pixels repeated: what is left of an error at viewing distance, which
/// is small for blue noise. Not corrected for the reference's noise.
/// @param  sigma  in pixels; 0: no filter
[[nodiscard]] double blurred_mse(std::span<const float> image, std::span<const float> reference, int width, int height, double sigma);

}  // namespace koksma
