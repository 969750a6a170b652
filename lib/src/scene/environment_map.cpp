#include <koksma/scene/environment_map.h>

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include <algorithm>
#include <bit>
#include <cmath>
#include <numbers>
#include <numeric>
#include <span>
#include <vector>

namespace koksma {

namespace {

Vec3f row_of(const glm::dmat3& m, int row) {
    return {static_cast<float>(m[0][row]), static_cast<float>(m[1][row]), static_cast<float>(m[2][row])};
}

constexpr double kPiDouble = std::numbers::pi;

/// Where each weight begins in [0, kWhole), and kWhole: one part to each weight that is not zero, the rest in proportion.
std::vector<std::int32_t> beginnings(std::span<const double> weights) {
    const double total = std::accumulate(weights.begin(), weights.end(), 0.0);
    const auto positive = static_cast<std::int32_t>(std::count_if(weights.begin(), weights.end(), [](double w) { return w > 0.0; }));
    std::vector<std::int32_t> begin;
    double sum = 0.0;
    std::int32_t before = 0;
    for (const double w : weights) {
        begin.push_back(before + (total > 0.0 ? static_cast<std::int32_t>(sum / total * (kWhole - positive)) : 0));
        sum += w;
        before += w > 0.0 ? 1 : 0;
    }
    begin.push_back(kWhole);
    return begin;
}

/// Adds a row to the guide of an InversionTable.
template <class Vector>
void append_guide(std::span<const std::int32_t> begin, Vector& guide) {
    const auto entries = static_cast<std::int32_t>(begin.size()) - 1, parts = guide_parts(entries);
    std::int32_t i = 0;
    for (std::int32_t part = 0; part <= parts; ++part) {
        while (i + 1 < entries && begin[static_cast<std::size_t>(i + 1)] <= part * (kWhole / parts)) ++i;
        guide.push_back(i);
    }
}

}  // namespace

EnvironmentMap::EnvironmentMap(const MapEnvironment& description) : width_(description.image->width), height_(description.image->height) {
    const Image& image = *description.image;
    const int image_rows = height_;
    if (height_ == 1) height_ = 2;  // one row: both poles see it
    const auto texel = [&](int y, int x) {
        return Vec3f(image.texels[static_cast<std::size_t>(y % image_rows) * width_ + x % width_]) * description.scale;
    };

    column_guide_.reserve(static_cast<std::size_t>(guide_parts(width_) + 1) * (height_ - 1));
    texels_.reserve(static_cast<std::size_t>(width_ + 1) * height_ * 4);
    const auto append_texel = [&](int y, int x, std::int32_t begin) {
        const Vec3f radiance = texel(y, x);
        for (const float f : {radiance.x, radiance.y, radiance.z, std::bit_cast<float>(begin)}) texels_.push_back(f);
    };

    glm::dmat3 to_world(description.to_world);
    for (int i = 0; i < 3; ++i) to_world[i] = glm::normalize(to_world[i]);
    const glm::dmat3 to_map = glm::transpose(to_world);
    axis_x_ = row_of(to_map, 0);
    axis_y_ = row_of(to_map, 1);
    axis_z_ = row_of(to_map, 2);

    // A cell lies between four texels; its weight is their mean times its solid angle, so it is positive wherever the
    // interpolated radiance is.
    const int rows = height_ - 1;
    std::vector<double> cosines;
    for (int y = 0; y <= rows; ++y) {
        cosines.push_back(std::cos(kPiDouble * y / rows));
        const double sine = std::sin(0.5 * kPiDouble * y / rows);
        half_sine2_.push_back(static_cast<float>(sine * sine));
    }
    const auto band = [&](int y) { return 2.0 * kPiDouble * (cosines[y] - cosines[y + 1]); };  // solid angle of a row of cells
    std::vector<double> row_weights, weights(static_cast<std::size_t>(width_));
    Vec3d sum;
    for (int y = 0; y < rows; ++y) {
        double row_sum = 0.0;
        for (int x = 0; x < width_; ++x) {
            const Vec3d cell = (to_double(texel(y, x)) + to_double(texel(y, x + 1)) + to_double(texel(y + 1, x)) + to_double(texel(y + 1, x + 1))) * 0.25;
            weights[x] = (cell.x + cell.y + cell.z) * band(y);
            row_sum += weights[x];
            sum += cell * (band(y) / width_);
        }
        const std::vector<std::int32_t> begin = beginnings(weights);
        append_guide(begin, column_guide_);
        for (int x = 0; x <= width_; ++x) append_texel(y, x, begin[x]);
        row_weights.push_back(row_sum);
        black_ = black_ && !(row_sum > 0.0);
    }
    for (int x = 0; x <= width_; ++x) append_texel(rows, x, 0);
    const std::vector<std::int32_t> begin = beginnings(row_weights);
    append_guide(begin, row_guide_);
    for (const std::int32_t b : begin) row_begin_.push_back(std::bit_cast<float>(b));
    for (int y = 0; y < rows; ++y) {
        const double row_parts = row_weights[y] > 0.0 ? begin[y + 1] - begin[y] : 0;
        row_density_.push_back(static_cast<float>(row_parts / kWhole / kWhole * width_ / band(y)));
    }
    mean_ = to_float(sum * (1.0 / (4.0 * kPiDouble)));
}

}  // namespace koksma
