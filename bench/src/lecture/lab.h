#pragma once
// What the lecture's topics share: small scenes, replicates, and errors that need no reference.

#include "../commands.h"

#include <koksma/integrators/lecture/render_estimate.h>
#include <koksma/measure/statistics.h>

#include <string>
#include <utility>
#include <vector>

namespace koksma::lecture {

/// Where topics are measured, and how thoroughly.
struct Lab {
    const Registry& registry;
    std::filesystem::path out;  ///< pictures go to out/pictures
    std::uint64_t seed = 0;
    int threads = 0;
    bool quick = false;
    /// A quarter of the replicates for a first look, three at least.
    [[nodiscard]] int replicates(int n) const { return quick ? std::max(3, n / 4) : n; }
};

/// A scene that ships, ready for any estimator.
struct Stage {
    std::string name;
    Scene scene;
    IntegratorSettings integrator;
};

/// @param file     below scenes/, as in "cornell.xml"
/// @param defines  values of the scene's parameters
[[nodiscard]] Stage open(const std::string& file, const SceneParameters& defines);

/// Without what emitters send straight into the camera: at the edge of a lamp that is all the error there is, whatever is compared.
[[nodiscard]] Stage open_scattered(const std::string& file, const SceneParameters& defines);

using Image = std::vector<float>;

/// Replicates of one estimator: image, terms of the series (if asked for) and what they cost.
struct Replicates {
    std::vector<Image> images;
    std::vector<std::vector<Image>> terms;  ///< by term, then replicate
    Ledger ledger;                          ///< of all of them
    std::uint64_t spp = 0;
    [[nodiscard]] double rays_per_sample() const {
        return static_cast<double>(ledger.rays.closest + ledger.rays.shadow) / static_cast<double>(ledger.samples);
    }
    [[nodiscard]] double rays_per_pixel() const { return rays_per_sample() * static_cast<double>(spp); }
};

/// By the recursive estimator.
[[nodiscard]] Replicates replicate(const Lab& lab, const Stage& stage, const EstimatorSettings& settings, const std::string& sampler,
                                   std::uint64_t spp, int count, bool terms = false);

/// By the production kernels. @param centre  all samples at the centre of their pixel
[[nodiscard]] std::vector<Image> replicate(const Lab& lab, const Stage& stage, const std::string& sampler, std::uint64_t spp, int count,
                                           bool centre = false);

/// One value a replicate: the mean squared difference from the mean of the others, scaled so that its expectation is the variance of an
/// image. Of an estimator without bias this is the MSE, without a reference.
[[nodiscard]] std::vector<double> squared_errors(const std::vector<Image>& images);
/// Against what is known.
[[nodiscard]] std::vector<double> squared_errors(const std::vector<Image>& images, const Image& truth);
/// Means over pixels and channels.
[[nodiscard]] std::vector<double> means(const std::vector<Image>& images);
/// Pixel by pixel.
[[nodiscard]] Image mean_image(const std::vector<Image>& images);
[[nodiscard]] Image sum_of(const std::vector<Image>& images);

[[nodiscard]] EstimatorSettings estimator(Technique light, std::string_view end = "throughput", std::uint32_t branching = 1);

inline const std::string kRandom = "random", kSobol = "sobol:randomize=owen";

}  // namespace koksma::lecture
