#pragma once
// Values over space at render time. A constant costs no lookup.

#include <koksma/math/vec3.h>
#include <koksma/scene/description.h>

#include <memory>

namespace koksma {

/// A volume placed in the scene's space.
struct VolumeField {
    Vec3f constant{0.0f};  ///< where there is no grid
    std::shared_ptr<const VolumeGrid> grid;
    bool nearest = false;
    GridVolume::Wrap wrap = GridVolume::Wrap::clamp;
    Vec3f rows[3], offset;  ///< to the unit cube: dot(rows[i], p) + offset[i]
};

/// The value at a point, interpolated between the centres of the cells.
[[nodiscard]] Vec3f value_at(const VolumeField& field, Vec3f p) noexcept;

/// The largest value of each channel, interpolation included.
[[nodiscard]] Vec3f largest_value(const Volume& volume) noexcept;

}  // namespace koksma
