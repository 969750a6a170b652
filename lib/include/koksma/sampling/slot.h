#pragma once
// Dimensions are data: every random decision of a path has a named slot with a fixed place in the sequence.

#include <cstdint>
#include <span>
#include <string_view>

namespace koksma {

/// What a number is used for. One decision, one role.
enum class SlotRole : std::uint8_t {
    film,            ///< position within the pixel, 2-D
    lens,            ///< position on the aperture, 2-D
    time,            ///< instant within the shutter interval, 1-D
    light_choice,    ///< which light to sample, 1-D
    light_position,  ///< point on (or direction to) the chosen light, 2-D
    lobe,            ///< which lobe of the BSDF (reflection or transmission), 1-D
    direction,       ///< direction from the BSDF or the phase function, 2-D
    roulette,        ///< Russian roulette, 1-D
    distance,        ///< how far a path comes in media, 1-D
    collision,       ///< which collision with a heterogeneous medium is real, 1-D
    passage,         ///< which of the surfaces that let a part pass stops the path, 1-D
    transmittance,   ///< steps of a shadow ray through heterogeneous media; from the tail alone
};

[[nodiscard]] constexpr std::string_view name(SlotRole role) noexcept {
    constexpr std::string_view kNames[] = {"film", "lens", "time", "light choice", "light position", "lobe", "direction", "roulette",
                                           "distance", "collision", "passage", "transmittance"};
    return kNames[static_cast<int>(role)];
}

/// One draw of a path: `arity` numbers at dimensions [dimension, dimension + arity).
struct Slot {
    std::uint32_t dimension = 0;  ///< first dimension
    std::uint16_t bounce = 0;     ///< vertex at which it is drawn; 0 for the camera and for the first surface hit
    SlotRole role = SlotRole::film;
    std::uint8_t arity = 1;       ///< 1 or 2: how many numbers are drawn jointly
    std::uint16_t group = 0;      ///< slots of one group may be drawn jointly by samplers with groups larger than 2
};

/// A run of consecutive slots; their dimensions are consecutive too.
using SlotRun = std::span<const Slot>;

[[nodiscard]] constexpr std::uint32_t dimension_count(SlotRun run) noexcept {
    return run.empty() ? 0 : run.back().dimension + run.back().arity - run.front().dimension;
}

}  // namespace koksma
