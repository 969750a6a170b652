#include <koksma/scene/environment_map.h>
#include <koksma/simd/elementary.h>

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include <cmath>
#include <numbers>

namespace koksma {

namespace {

Vec3f row_of(const glm::dmat3& m, int row) {
    return {static_cast<float>(m[0][row]), static_cast<float>(m[1][row]), static_cast<float>(m[2][row])};
}

constexpr double kPiDouble = std::numbers::pi;

}  // namespace

EnvironmentMap::EnvironmentMap(const MapEnvironment& description) : width_(description.image->width), height_(description.image->height) {
    const Image& image = *description.image;
    const int image_rows = height_;
    if (height_ == 1) height_ = 2;  // one row: both poles see it
    texels_.reserve(static_cast<std::size_t>(width_ + 1) * height_);
    for (int y = 0; y < height_; ++y)
        for (int x = 0; x <= width_; ++x)
            texels_.push_back(Vec3f(image.texels[static_cast<std::size_t>(y % image_rows) * width_ + x % width_]) * description.scale);

    glm::dmat3 to_world(description.to_world);
    for (int i = 0; i < 3; ++i) to_world[i] = glm::normalize(to_world[i]);
    const glm::dmat3 to_map = glm::transpose(to_world);
    axis_x_ = row_of(to_map, 0);
    axis_y_ = row_of(to_map, 1);
    axis_z_ = row_of(to_map, 2);

    // A cell lies between four texels; its weight is their mean times its solid angle, so it is positive wherever the
    // interpolated radiance is.
    const int rows = height_ - 1;
    for (int y = 0; y <= rows; ++y) row_cos_.push_back(std::cos(kPiDouble * y / rows));
    const auto band = [&](int y) { return 2.0 * kPiDouble * (row_cos_[y] - row_cos_[y + 1]); };  // solid angle of a row of cells
    std::vector<double> row_weights, weights(static_cast<std::size_t>(width_));
    Vec3d sum;
    for (int y = 0; y < rows; ++y) {
        double row_sum = 0.0;
        for (int x = 0; x < width_; ++x) {
            const Vec3f* t = &texels_[static_cast<std::size_t>(y) * (width_ + 1) + x];
            const Vec3d cell = (to_double(t[0]) + to_double(t[1]) + to_double(t[width_ + 1]) + to_double(t[width_ + 2])) * 0.25;
            weights[x] = (cell.x + cell.y + cell.z) * band(y);
            row_sum += weights[x];
            sum += cell * (band(y) / width_);
        }
        columns_.emplace_back(weights);
        row_weights.push_back(row_sum);
    }
    rows_ = DiscreteDistribution(row_weights);
    cell_pdf_.reserve(static_cast<std::size_t>(width_) * rows);
    for (int y = 0; y < rows; ++y)
        for (int x = 0; x < width_; ++x) {
            const float probability = is_black() ? 0.0f : rows_.probability(static_cast<std::uint32_t>(y)) * columns_[y].probability(static_cast<std::uint32_t>(x));
            cell_pdf_.push_back(probability / (static_cast<float>(band(y)) / static_cast<float>(width_)));
        }
    mean_ = to_float(sum * (1.0 / (4.0 * kPiDouble)));
}

Vec3f EnvironmentMap::sample(Vec2f u) const noexcept {
    const DiscreteSample row = rows_.sample(u.y);
    const DiscreteSample column = columns_[row.index].sample(u.x);
    // Uniform in solid angle within the cell: linear in azimuth and in the cosine.
    const double c0 = row_cos_[row.index], c1 = row_cos_[row.index + 1];
    // In double: by the poles of a large map a row of cells spans only a few floats of the cosine.
    const double c = c0 + (c1 - c0) * row.u, sin2 = (1.0 - c) * (1.0 + c);
    const auto cos_theta = static_cast<float>(c), sin_theta = static_cast<float>(std::sqrt(sin2 > 0.0 ? sin2 : 0.0));
    const SinCos phi = sincos_turns((static_cast<float>(column.index) + column.u + 0.5f) / static_cast<float>(width_));
    const Vec3f v{sin_theta * phi.sin, cos_theta, -sin_theta * phi.cos};
    return axis_x_ * v.x + axis_y_ * v.y + axis_z_ * v.z;
}

}  // namespace koksma
