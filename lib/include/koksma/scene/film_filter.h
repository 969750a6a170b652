#pragma once
// Where in and around its pixel a sample lies: positions drawn from the reconstruction filter, so that every sample has weight one.

#include <koksma/scene/description.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace koksma {

/// One axis of a filter, by inversion. Filters are separable and even.
struct CompiledFilter {
    /// Distance from the pixel's centre by s = sqrt(1 - w), w the part of the filter nearer than that: evenly spaced in s, in
    /// which the distance has no steep end. Empty: every sample lies in its own pixel.
    std::vector<float> distance;
    /// Part of the filter that lies beyond a border k + 1/2 pixels from the centre, k = 0, 1 ...; empty: nothing is cut off.
    std::vector<float> beyond;

    [[nodiscard]] bool is_pixel() const noexcept { return distance.empty(); }

    /// @param pixel  of `size` along this axis
    /// @param u      in [0, 1)
    /// @return       position relative to the pixel's lower end; in [0, 1) for a box of one pixel. Nondecreasing in u
    [[nodiscard]] float position(std::int32_t pixel, std::int32_t size, float u) const noexcept {
        const auto cut = [&](std::int32_t k) { return k < static_cast<std::int32_t>(beyond.size()) ? beyond[static_cast<std::size_t>(k)] : 0.0f; };
        const float low = cut(pixel), high = 1.0f - cut(size - 1 - pixel);
        const float w = 2.0f * (low + u * (high - low)) - 1.0f;
        const float rest = 1.0f - std::fabs(w);
        const float s = std::sqrt(rest > 0.0f ? rest : 0.0f) * static_cast<float>(distance.size() - 1);
        const auto cell = static_cast<std::size_t>(s) < distance.size() - 1 ? static_cast<std::size_t>(s) : distance.size() - 2;
        const float part = s - static_cast<float>(cell);
        const float d = distance[cell] + (distance[cell + 1] - distance[cell]) * part;
        return 0.5f + (w < 0.0f ? -d : d);
    }
};

/// Tables for a filter; the distance is off by less than 1e-6 of the radius.
/// @throws Error for a radius or deviation that is not positive or above kLargestFilterRadius
[[nodiscard]] CompiledFilter compile_filter(const ReconstructionFilter& filter);

inline constexpr double kLargestFilterRadius = 32.0;  ///< pixels

}  // namespace koksma
