#pragma once
// Do two independent renders of one scene agree? For halves of a reference, and for other renderers.

#include <cstdint>
#include <span>

namespace koksma {

/// z: difference of two means in units of its standard error. Standard normal if they agree.
struct Agreement {
    double max_block_z = 0;      ///< largest |z| of the mean of a block of 8x8 pixels, over blocks and channels
    double rms_z = 0;            ///< root mean square over the same: near 1 if the variances are right, 0 if blocks = 0
    double fraction_beyond_3 = 0;  ///< of the same with |z| > 3: 0.0027 for a normal
    double global_z[3] = {};     ///< of the mean of the image, per channel
    double max_pixel_z = 0;      ///< largest |z| of a single pixel: shows where, proves little (its variance has K - 1 degrees)
    int blocks = 0;              ///< blocks that were tested; those black without variance in both are not
    std::int64_t non_finite = 0;  ///< pixels left out: NaN or infinite in a mean or a variance
};

/// @param  mean_a, mean_b  shape (height, width, 3)
/// @param  var_a, var_b    variance of the mean, same shape; one of them may be empty: taken as exact
/// @note   Allows for the rounding of means to float (not to half). Takes pixels as independent: a sampler that shares its
///         randomisation between pixels makes z too large or too small. Pixels that few replicates found bright make z heavy-tailed.
/// @throws Error if the sizes disagree or both variances are empty
[[nodiscard]] Agreement agreement(std::span<const float> mean_a, std::span<const float> var_a, std::span<const float> mean_b,
                                  std::span<const float> var_b, int width, int height);

}  // namespace koksma
