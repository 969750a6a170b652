#pragma once
// Light from infinity out of a latitude-longitude image.

#include <koksma/scene/description.h>
#include <koksma/scene/distribution.h>
#include <koksma/math/vec3.h>

#include <vector>

namespace koksma {

/// Bilinear interpolation of radiance over direction, importance-sampled by cell. Mitsuba's convention: in the map's own
/// space +y is up, column j lies at azimuth 2 pi (j + 1/2) / width measured from -z towards +x, row i at polar angle
/// pi i / (height - 1): the first and the last row are the poles.
class EnvironmentMap {
public:
    explicit EnvironmentMap(const MapEnvironment& description);

    /// @param d  unit, world space
    [[nodiscard]] Vec3f radiance(Vec3f d) const noexcept;
    /// Draws a direction. @return pdf 0 if the map is black
    struct Sample {
        Vec3f d;
        float pdf_w = 0.0f;  ///< per steradian
    };
    [[nodiscard]] Sample sample(glm::vec2 u) const noexcept;
    [[nodiscard]] float pdf(Vec3f d) const noexcept;
    /// Mean radiance over the sphere.
    [[nodiscard]] Vec3f mean_radiance() const noexcept { return mean_; }

private:
    [[nodiscard]] glm::vec2 to_uv(Vec3f d) const noexcept;
    [[nodiscard]] Vec3f cell_lookup(float x, float y) const noexcept;
    int width_, height_;             ///< cells per row (wrapping), rows of texels
    std::vector<Vec3f> texels_;      ///< (height, width + 1): the first column is repeated at the end
    Vec3f axis_x_, axis_y_, axis_z_; ///< rows of world-to-map
    std::vector<double> row_cos_;    ///< cosine of the polar angle of each row of texels
    DiscreteDistribution rows_;
    std::vector<DiscreteDistribution> columns_;
    Vec3f mean_{0.0f};
};

}  // namespace koksma
