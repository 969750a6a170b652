#pragma once
// FLIP: how different two images look when one flips between them, 0 (not at all) to 1.
//
// Koksma's images are linear radiance without an exposure of their own, so what rows and reports hold is HDR-FLIP, as the published
// evaluator chooses for OpenEXR files. LDR-FLIP is its building block. Values equal the evaluator's (tests/measure/flip_oracle.py).
//
// FLIP is not corrected for the reference's noise: two images of a noisy reference differ by its noise. HdrFlip::of two halves of a
// reference says how much of a value that may be.
//
// Source: Andersson, Nilsson, Akenine-Moller, Oskarsson, Astrom, Fairchild 2020, "FLIP: A Difference Evaluator for Alternating Images",
// HPG; Andersson, Nilsson, Shirley, Akenine-Moller 2021, "Visualizing Errors in Rendered High Dynamic Range Images", Eurographics short

#include <span>
#include <vector>

namespace koksma {

/// A screen 0.7 m away, 0.7 m and 3840 pixels wide, as in the paper: 67.02 pixels a degree.
inline constexpr double kFlipPixelsPerDegree = 0.7 * 3840 / 0.7 * 3.14159265358979323846 / 180;

/// What FLIP knows of one image in [0, 1]: planes of shape (height, width).
struct FlipFeatures {
    std::vector<float> lightness, a, b;  ///< L*a*b* with Hunt's adjustment, after the contrast sensitivity filters
    std::vector<float> edge, point;      ///< magnitudes of first and second derivatives of luminance
};

/// @param  rgb  linear, shape (height, width, 3), not clamped; colour is clamped to [0, 1] after filtering, as the paper does
[[nodiscard]] FlipFeatures flip_features(std::span<const float> rgb, int width, int height, double pixels_per_degree = kFlipPixelsPerDegree);

/// LDR-FLIP of two images in [0, 1], shape (height, width). Symmetric.
/// @throws Error if a size is wrong
[[nodiscard]] std::vector<float> ldr_flip(std::span<const float> reference, std::span<const float> test, int width, int height,
                                          double pixels_per_degree = kFlipPixelsPerDegree);

/// HDR-FLIP against one reference, whose share of the work is done once: the pixelwise largest LDR-FLIP over exposures in steps of at
/// most a stop, from where the brightest pixel of the reference is tone mapped to 0.85 to where its median pixel is.
class HdrFlip {
public:
    /// @param  reference  linear radiance, shape (height, width, 3)
    /// @throws            Error if a size is wrong
    HdrFlip(std::span<const float> reference, int width, int height, double pixels_per_degree = kFlipPixelsPerDegree);

    /// The map, shape (height, width). Empty where there is no range of exposures (a reference that is black, or of one luminance), or a
    /// value of an image is not finite.
    /// @throws Error if the size is wrong
    [[nodiscard]] std::vector<float> map(std::span<const float> test) const;
    /// Its mean over the pixels that `skip` does not mark (empty: all); NaN where the map is empty or all is skipped.
    [[nodiscard]] double mean(std::span<const float> test, std::span<const unsigned char> skip = {}) const;

    [[nodiscard]] double start_exposure() const noexcept { return start_; }
    [[nodiscard]] double stop_exposure() const noexcept { return stop_; }
    [[nodiscard]] int exposures() const noexcept { return static_cast<int>(features_.size()); }

private:
    [[nodiscard]] double exposure(int i) const noexcept;

    int width_, height_;
    double pixels_per_degree_, start_ = 0, stop_ = 0;
    std::vector<FlipFeatures> features_;  ///< of the reference, per exposure
};

/// Mean of a map over the pixels that are not skipped.
[[nodiscard]] double mean_of_map(std::span<const float> map, std::span<const unsigned char> skip = {});

}  // namespace koksma
