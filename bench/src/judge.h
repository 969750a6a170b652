#pragma once
// What a render is compared with: a scene's reference, prepared once for all its renders.

#include "bench_scene.h"

#include <koksma/measure/flip.h>
#include <koksma/measure/metrics.h>

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace koksma {

/// The errors of one render, over the crop or over a part of it. NaN where there is none.
struct Errors {
    std::int64_t pixels = 0;
    double mse = 0, mse_raw = 0, relmse = 0, relmse_raw = 0;  ///< mse and relmse corrected for the reference's noise, _raw not
    double mae = 0, smape = 0, flip = 0;                      ///< not corrected; FLIP is HDR-FLIP, NaN where it was not asked for
};

/// Pixels whose camera samples can see an emitter or a shining environment directly, and their eight neighbours: 1. Of each pixel of the
/// crop, shape (height, width). Emitted light makes a pixel bright without an integral behind it, and its edge a step of that brightness.
/// @note  Asks 64 stratified samples a pixel: the emission-only render (max_depth 1) of the same scene. What covers less of a pixel than
///        they find is missed, unless a neighbour is found.
[[nodiscard]] std::vector<unsigned char> visible_emitters(const BenchScene& scene, const Registry& registry, int threads);

class Judge {
public:
    /// Keeps a pointer to the reference.
    Judge(const BenchScene& scene, const Reference& reference, const Registry& registry, int threads);

    struct Verdict {
        Errors all, masked;  ///< masked: without visible emitters
    };
    [[nodiscard]] Verdict judge(std::span<const float> image, bool with_flip) const;

    /// What the uncorrected metrics say of one half of the reference against the other: as far as that, a value may be the reference's
    /// noise (which is about half of it for MAE).
    [[nodiscard]] Errors between_halves() const;
    [[nodiscard]] const Reference& reference() const noexcept { return *reference_; }
    [[nodiscard]] const std::vector<unsigned char>& emitters() const noexcept { return emitters_; }
    [[nodiscard]] std::int64_t emitter_pixels() const noexcept;
    /// 16 hexadecimal digits of the reference's pixels.
    [[nodiscard]] const std::string& content() const noexcept { return content_; }

private:
    const Reference* reference_;
    std::string content_;
    HdrFlip flip_;
    std::vector<unsigned char> emitters_;
};

}  // namespace koksma
