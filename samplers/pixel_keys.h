#pragma once
// How the pixels of a per-pixel sampler differ: the option pixels=independent|shared.

#include <koksma/sampling/sampler.h>

namespace koksma {

/// The declaration of the option; the first value is the default.
[[nodiscard]] inline OptionInfo pixels_option() {
    return {"pixels", "independent", {"independent", "shared"}, "randomisation per pixel, or one for the whole film"};
}

/// The key of each pixel under a plan's seed and the option `pixels`.
class PixelKeys {
public:
    /// @param salt  one per sampler: samples of two samplers under one seed are independent (their replicates may be pooled)
    PixelKeys(const SamplerOptions& options, const SamplingPlan& plan, std::uint64_t salt)
        : seed_(plan.seed ^ salt), shared_(options.has("pixels") && options["pixels"] == "shared") {}

    [[nodiscard]] Key operator()(Pixel pixel) const noexcept { return pixel_key(seed_, shared_ ? Pixel{} : pixel); }

private:
    std::uint64_t seed_;
    bool shared_;
};

}  // namespace koksma
