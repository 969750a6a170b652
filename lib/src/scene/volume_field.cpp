#include <koksma/scene/medium/volume_field.h>

#include <algorithm>
#include <cmath>

namespace koksma {

namespace {

/// Coordinates far outside, where a float has no more fractions, must still become an index.
float tamed(float x, GridVolume::Wrap wrap) noexcept {
    if (wrap == GridVolume::Wrap::clamp) return std::clamp(x, -1.0f, 2.0f);
    if (wrap == GridVolume::Wrap::repeat) return x - std::floor(x);
    return x - 2.0f * std::floor(0.5f * x);
}

std::int32_t wrapped(std::int32_t i, std::int32_t n, GridVolume::Wrap wrap) noexcept {
    if (wrap == GridVolume::Wrap::clamp) return std::clamp(i, 0, n - 1);
    const std::int32_t period = wrap == GridVolume::Wrap::repeat ? n : 2 * n;
    std::int32_t r = i % period;
    if (r < 0) r += period;
    return r < n ? r : 2 * n - 1 - r;
}

/// Two neighbouring cells along an axis, and how near the second is.
struct Span {
    std::int32_t first = 0, second = 0;
    float weight = 0.0f;
};

Span span_of(float x, std::int32_t n, const VolumeField& field) noexcept {
    const float at = tamed(x, field.wrap) * static_cast<float>(n) - (field.nearest ? 0.0f : 0.5f);
    const float below = std::floor(at);
    const auto i = static_cast<std::int32_t>(below);
    if (field.nearest) return {wrapped(i, n, field.wrap), 0, 0.0f};
    return {wrapped(i, n, field.wrap), wrapped(i + 1, n, field.wrap), at - below};
}

Vec3f cell(const VolumeGrid& grid, std::int32_t x, std::int32_t y, std::int32_t z) noexcept {
    const auto index = (static_cast<std::size_t>(z) * static_cast<std::size_t>(grid.size[1]) + static_cast<std::size_t>(y)) *
                           static_cast<std::size_t>(grid.size[0]) +
                       static_cast<std::size_t>(x);
    if (grid.channels == 1) return Vec3f(grid.values[index]);
    return {grid.values[3 * index], grid.values[3 * index + 1], grid.values[3 * index + 2]};
}

Vec3f mixed(Vec3f a, Vec3f b, float weight) noexcept { return a * (1.0f - weight) + b * weight; }

}  // namespace

Vec3f value_at(const VolumeField& field, Vec3f p) noexcept {
    if (!field.grid) return field.constant;
    const VolumeGrid& grid = *field.grid;
    const Span x = span_of(dot(field.rows[0], p) + field.offset.x, grid.size[0], field);
    const Span y = span_of(dot(field.rows[1], p) + field.offset.y, grid.size[1], field);
    const Span z = span_of(dot(field.rows[2], p) + field.offset.z, grid.size[2], field);
    if (field.nearest) return cell(grid, x.first, y.first, z.first);
    const auto along_x = [&](std::int32_t iy, std::int32_t iz) {
        return mixed(cell(grid, x.first, iy, iz), cell(grid, x.second, iy, iz), x.weight);
    };
    const auto along_y = [&](std::int32_t iz) { return mixed(along_x(y.first, iz), along_x(y.second, iz), y.weight); };
    return mixed(along_y(z.first), along_y(z.second), z.weight);
}

Vec3f largest_value(const Volume& volume) noexcept {
    if (const auto* constant = std::get_if<ConstantVolume>(&volume)) return constant->value;
    const VolumeGrid& grid = *std::get<GridVolume>(volume).grid;
    Vec3f largest{0.0f};
    for (std::size_t i = 0; i < grid.values.size(); ++i) {
        const float v = grid.values[i];
        if (grid.channels == 1)
            largest = {std::max(largest.x, v), std::max(largest.y, v), std::max(largest.z, v)};
        else if (i % 3 == 0)
            largest.x = std::max(largest.x, v);
        else if (i % 3 == 1)
            largest.y = std::max(largest.y, v);
        else
            largest.z = std::max(largest.z, v);
    }
    return largest;
}

}  // namespace koksma
