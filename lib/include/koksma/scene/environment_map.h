#pragma once
// Light from infinity out of a latitude-longitude image.

#include <koksma/scene/description.h>
#include <koksma/scene/environment_direction.h>
#include <koksma/scene/environment_value.h>
#include <koksma/math/vec3.h>
#include <koksma/scene/huge_pages.h>

#include <cstdint>
#include <vector>

namespace koksma {

/// Bilinear interpolation of radiance over direction, importance-sampled by cell. Mitsuba's convention: in the map's own
/// space +y is up, column j lies at azimuth 2 pi (j + 1/2) / width measured from -z towards +x, row i at polar angle
/// pi i / (height - 1): the first and the last row are the poles.
class EnvironmentMap {
public:
    explicit EnvironmentMap(const MapEnvironment& description);

    /// For environment_place() and environment_at().
    [[nodiscard]] EnvironmentTable table() const noexcept { return {width_, height_, texels_.data(), row_density_.data(), axis_x_, axis_y_, axis_z_}; }
    [[nodiscard]] bool is_black() const noexcept { return black_; }
    /// For environment_direction(): draws by cells. @pre  !is_black()
    [[nodiscard]] EnvironmentCells cells() const noexcept {
        return {{height_ - 1, guide_parts(height_ - 1), row_begin_.data(), row_guide_.data()},
                {width_, guide_parts(width_), texels_.data() + 3, column_guide_.data()},
                half_sine2_.data(),
                axis_x_,
                axis_y_,
                axis_z_};
    }
    /// Mean radiance over the sphere.
    [[nodiscard]] Vec3f mean_radiance() const noexcept { return mean_; }

private:
    int width_, height_;             ///< cells per row (wrapping), rows of texels
    LargeVector<float> texels_;     ///< as in EnvironmentTable
    Vec3f axis_x_, axis_y_, axis_z_; ///< rows of world-to-map
    std::vector<float> half_sine2_;  ///< sin^2 of half the polar angle of each row of texels
    std::vector<float> row_density_;
    std::vector<float> row_begin_;   ///< as InversionTable::begin
    std::vector<std::int32_t> row_guide_;
    LargeVector<std::int32_t> column_guide_;
    bool black_ = true;
    Vec3f mean_{0.0f};
};

}  // namespace koksma
