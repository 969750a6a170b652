#pragma once
// Light from infinity out of a latitude-longitude image.

#include <koksma/scene/description.h>
#include <koksma/scene/environment_direction.h>
#include <koksma/scene/environment_value.h>
#include <koksma/math/vec3.h>

#include <span>
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
        return {rows_.table(), columns_.table(), half_sine2_.data(), axis_x_, axis_y_, axis_z_};
    }
    /// Mean radiance over the sphere.
    [[nodiscard]] Vec3f mean_radiance() const noexcept { return mean_; }

private:
    /// The memory of an InversionTable.
    class Distributions {
    public:
        /// @param weights  of one row, finite, >= 0. @return  the parts of kWhole that each has, the whole of all
        std::span<const std::int32_t> add_row(std::span<const double> weights);
        [[nodiscard]] InversionTable table() const noexcept { return {entries_, parts_, begin_.data(), guide_.data()}; }

    private:
        std::int32_t entries_ = 0, parts_ = 0;
        std::vector<std::int32_t> begin_, guide_;
    };

    int width_, height_;             ///< cells per row (wrapping), rows of texels
    std::vector<float> texels_;      ///< as in EnvironmentTable
    Vec3f axis_x_, axis_y_, axis_z_; ///< rows of world-to-map
    std::vector<float> half_sine2_;  ///< sin^2 of half the polar angle of each row of texels
    std::vector<float> row_density_;
    Distributions rows_, columns_;
    bool black_ = true;
    Vec3f mean_{0.0f};
};

}  // namespace koksma
