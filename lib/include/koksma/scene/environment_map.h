#pragma once
// Light from infinity out of a latitude-longitude image.

#include <koksma/scene/description.h>
#include <koksma/scene/distribution.h>
#include <koksma/scene/environment_value.h>
#include <koksma/math/vec3.h>

#include <vector>

namespace koksma {

/// Bilinear interpolation of radiance over direction, importance-sampled by cell. Mitsuba's convention: in the map's own
/// space +y is up, column j lies at azimuth 2 pi (j + 1/2) / width measured from -z towards +x, row i at polar angle
/// pi i / (height - 1): the first and the last row are the poles.
class EnvironmentMap {
public:
    explicit EnvironmentMap(const MapEnvironment& description);

    /// For environment_value(): radiance and density of a direction.
    [[nodiscard]] EnvironmentTable table() const noexcept { return {width_, height_, texels_.data(), cell_pdf_.data(), axis_x_, axis_y_, axis_z_}; }
    [[nodiscard]] bool is_black() const noexcept { return !(rows_.total() > 0.0); }
    /// Draws a direction by cells; its density is environment_value's. @pre  !is_black()
    [[nodiscard]] Vec3f sample(Vec2f u) const noexcept;
    /// Mean radiance over the sphere.
    [[nodiscard]] Vec3f mean_radiance() const noexcept { return mean_; }

private:
    int width_, height_;             ///< cells per row (wrapping), rows of texels
    std::vector<Vec3f> texels_;      ///< (height, width + 1): the first column is repeated at the end
    Vec3f axis_x_, axis_y_, axis_z_; ///< rows of world-to-map
    std::vector<double> row_cos_;    ///< cosine of the polar angle of each row of texels
    std::vector<float> cell_pdf_;
    DiscreteDistribution rows_;
    std::vector<DiscreteDistribution> columns_;
    Vec3f mean_{0.0f};
};

}  // namespace koksma
