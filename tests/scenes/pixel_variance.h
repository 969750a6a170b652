#pragma once
// The mean squared error of unbiased renders, without a reference: the variance over replicates.

#include "render_scene.h"

namespace koksma::testing {

/// Unbiased variance over replicates, per pixel, green channel. Seeds are disjoint for different spp and samplers.
[[nodiscard]] inline std::vector<double> pixel_variances(const Ready& ready, std::string_view sampler, std::uint64_t spp, int replicates) {
    const PixelRect r = crop_of(ready.scene.film);
    std::vector<double> sum(static_cast<std::size_t>(r.area())), squares(sum.size());
    std::uint64_t name = 0;
    for (const char c : sampler) name = mix64(name ^ static_cast<unsigned char>(c));
    for (int k = 0; k < replicates; ++k) {
        const Film film = ready.render(sampler, spp, mix64(name + spp * 1000 + static_cast<std::uint64_t>(k)) >> 1).film;
        std::size_t i = 0;
        for (std::int32_t y = r.y; y < r.y + r.height; ++y)
            for (std::int32_t x = r.x; x < r.x + r.width; ++x, ++i) {
                const double v = film.mean({x, y}).y;
                sum[i] += v;
                squares[i] += v * v;
            }
    }
    for (std::size_t i = 0; i < sum.size(); ++i) squares[i] = std::max(0.0, (squares[i] - sum[i] * sum[i] / replicates) / (replicates - 1));
    return squares;
}

}  // namespace koksma::testing
