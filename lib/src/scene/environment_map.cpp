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
    mean_ = to_float(sum * (1.0 / (4.0 * kPiDouble)));
}

glm::vec2 EnvironmentMap::to_uv(Vec3f d) const noexcept {
    const Vec3f v{dot(axis_x_, d), dot(axis_y_, d), dot(axis_z_, d)};
    float u = atan2_poly(v.x, -v.z) * (0.5f * kInvPi) - 0.5f / static_cast<float>(width_);  // a texel's column is its middle
    if (u < 0.0f) u += 1.0f;
    if (!(u < 1.0f)) u = 0.0f;  // -1e-10 + 1 rounds to 1
    return {u, atan2_poly(std::sqrt(v.x * v.x + v.z * v.z), v.y) * kInvPi};
}

Vec3f EnvironmentMap::cell_lookup(float x, float y) const noexcept {
    int ix = static_cast<int>(x), iy = static_cast<int>(y);
    if (ix > width_ - 1) ix = width_ - 1;
    if (iy > height_ - 2) iy = height_ - 2;
    const float wx = x - static_cast<float>(ix), wy = y - static_cast<float>(iy);
    const Vec3f* t = &texels_[static_cast<std::size_t>(iy) * (width_ + 1) + ix];
    return (t[0] * (1.0f - wx) + t[1] * wx) * (1.0f - wy) + (t[width_ + 1] * (1.0f - wx) + t[width_ + 2] * wx) * wy;
}

Vec3f EnvironmentMap::radiance(Vec3f d) const noexcept {
    const glm::vec2 uv = to_uv(d);
    return cell_lookup(uv.x * static_cast<float>(width_), uv.y * static_cast<float>(height_ - 1));
}

EnvironmentMap::Sample EnvironmentMap::sample(glm::vec2 u) const noexcept {
    if (!(rows_.total() > 0.0)) return {};
    const DiscreteSample row = rows_.sample(u.y);
    const DiscreteSample column = columns_[row.index].sample(u.x);
    // Uniform in solid angle within the cell: linear in azimuth and in the cosine.
    const double c0 = row_cos_[row.index], c1 = row_cos_[row.index + 1];
    // In double: by the poles of a large map a row of cells spans only a few floats of the cosine.
    const double c = c0 + (c1 - c0) * row.u, sin2 = (1.0 - c) * (1.0 + c);
    const auto cos_theta = static_cast<float>(c), sin_theta = static_cast<float>(std::sqrt(sin2 > 0.0 ? sin2 : 0.0));
    const SinCos phi = sincos_turns((static_cast<float>(column.index) + column.u + 0.5f) / static_cast<float>(width_));
    const Vec3f v{sin_theta * phi.sin, cos_theta, -sin_theta * phi.cos};
    const Vec3f d = axis_x_ * v.x + axis_y_ * v.y + axis_z_ * v.z;
    return {d, pdf(d)};
}

float EnvironmentMap::pdf(Vec3f d) const noexcept {
    if (!(rows_.total() > 0.0)) return 0.0f;
    const glm::vec2 uv = to_uv(d);
    const int rows = height_ - 1;
    int ix = static_cast<int>(uv.x * static_cast<float>(width_)), iy = static_cast<int>(uv.y * static_cast<float>(rows));
    if (ix > width_ - 1) ix = width_ - 1;
    if (iy > rows - 1) iy = rows - 1;
    const auto cell = static_cast<float>(2.0 * kPiDouble * (row_cos_[iy] - row_cos_[iy + 1])) / static_cast<float>(width_);
    return rows_.probability(static_cast<std::uint32_t>(iy)) * columns_[static_cast<std::size_t>(iy)].probability(static_cast<std::uint32_t>(ix)) / cell;
}

}  // namespace koksma
