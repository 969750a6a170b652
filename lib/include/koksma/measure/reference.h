#pragma once
// A high-spp image that knows its own error: two halves by different samplers, each from independent replicates.

#include <koksma/film/film.h>
#include <koksma/scene/description.h>

#include <cstdint>
#include <filesystem>
#include <iosfwd>
#include <span>
#include <string>
#include <vector>

namespace koksma {

/// Bumped by hand whenever the expected value of a render may change (integrator, BSDFs, lights, loader): references of
/// another version are refused. Guarded by the golden renders in tests/scenes.
inline constexpr int kEstimatorVersion = 1;

/// What a reference is the answer to.
struct ReferenceKey {
    std::string scene;             ///< name, for people
    std::uint64_t scene_hash = 0;  ///< SceneDescription::hash
    PixelRect rect;
    IntegratorSettings integrator;
    int estimator_version = kEstimatorVersion;
    /// 16 hexadecimal digits of all of it.
    [[nodiscard]] std::string digest() const;
};

/// Mean over the replicates of one sampler, and the variance of that mean.
struct ReferenceHalf {
    std::string sampler;
    int replicates = 0;
    std::uint64_t spp = 0;          ///< per replicate
    std::vector<float> mean;        ///< (height, width, 3)
    std::vector<float> variance;    ///< of the mean, per channel
};

/// Adds up replicates in the order in which they are given.
class HalfAccumulator {
public:
    void add(std::span<const float> image);
    /// @throws Error with fewer than two replicates
    [[nodiscard]] ReferenceHalf finish(std::string sampler, std::uint64_t spp) const;
    [[nodiscard]] int replicates() const noexcept { return n_; }

    /// The sums as they are, bit by bit: what is read goes on as if it had never stopped. Native byte order; not for other machines.
    void write(std::ostream& out) const;
    /// @throws Error if it is not what write() wrote
    [[nodiscard]] static HalfAccumulator read(std::istream& in);

private:
    std::vector<double> sum_, sum_of_squares_, shift_;
    int n_ = 0;
};

struct Reference {
    ReferenceKey key;
    ReferenceHalf halves[2];
    std::vector<float> mean;      ///< of both halves, weighted by their mean precision
    std::vector<float> variance;  ///< of that mean

    /// Fills mean and variance from the halves.
    void combine();
    [[nodiscard]] std::uint64_t spp_total() const noexcept;
    /// Root of the mean variance: the standard error that an RMSE sees.
    [[nodiscard]] double standard_error() const noexcept;
};

/// Writes / reads a reference as EXR. Reading checks that it answers `key`.
/// @throws Error with the path; for another key: what differs
void save_reference(const std::filesystem::path& file, const Reference& reference);
[[nodiscard]] Reference load_reference(const std::filesystem::path& file, const ReferenceKey& key);

/// "cornell-0123456789abcdef.exr"
[[nodiscard]] std::string reference_file_name(const ReferenceKey& key);

}  // namespace koksma
