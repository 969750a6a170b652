// Radiance and density of an environment map in a direction: one lookup gives both.

#include <koksma/math/vec3.h>
#include <koksma/simd/elementary.h>

#if defined(KOKSMA_SCENE_ENVIRONMENT_VALUE_H) == defined(KOKSMA_MATHS_TOGGLE)
#ifdef KOKSMA_SCENE_ENVIRONMENT_VALUE_H
#undef KOKSMA_SCENE_ENVIRONMENT_VALUE_H
#else
#define KOKSMA_SCENE_ENVIRONMENT_VALUE_H
#endif

#ifdef KOKSMA_ORDINARY
namespace koksma {

/// What a lookup reads.
struct EnvironmentTable {
    std::int32_t width = 0, height = 0;   ///< cells per row (wrapping), rows of texels
    const Vec3f* texels = nullptr;        ///< (height, width + 1): the first column is repeated at the end
    const std::int32_t* begin = nullptr;  ///< (height - 1, width + 1): where each cell's part of its row begins (environment_direction.h)
    const float* row_density = nullptr;   ///< (height - 1): density per steradian of a cell that has one part
    Vec3f axis_x, axis_y, axis_z;         ///< rows of world-to-map
};

}  // namespace koksma
#endif

KOKSMA_MATHS_BEGIN

/// Where a direction meets the map.
template <class Real>
struct EnvironmentPlaceOf {
    IntOf<Real> column, row;  ///< of the cell
    Real x, y;                ///< within it
};

/// @param d  unit, world space
template <class Real>
[[nodiscard]] EnvironmentPlaceOf<Real> environment_place(const EnvironmentTable& t, Vec3<Real> d) noexcept {
    using Int = IntOf<Real>;
    const Vec3<Real> v{dot(Vec3<Real>::splat(t.axis_x), d), dot(Vec3<Real>::splat(t.axis_y), d), dot(Vec3<Real>::splat(t.axis_z), d)};
    const auto width = static_cast<float>(t.width), rows = static_cast<float>(t.height - 1);
    Real u = atan2_poly(v.x, -v.z) * Real(0.5f * kInvPi) - Real(0.5f / width);  // a texel's column is its middle
    u = select(u < Real(0.0f), u + Real(1.0f), u);
    u = select(u < Real(1.0f), u, Real(0.0f));  // -1e-10 + 1 rounds to 1
    const Real x = u * Real(width), y = atan2_poly(sqrt(v.x * v.x + v.z * v.z), v.y) * Real(kInvPi) * Real(rows);
    const auto cell = [](Real at, std::int32_t last) {
        const Int i = to_int(at);
        return select(i > Int(0), select(i < Int(last), i, Int(last)), Int(0));
    };
    const Int ix = cell(x, t.width - 1), iy = cell(y, t.height - 2);
    return {ix, iy, x - to_real(ix), y - to_real(iy)};
}

/// Radiance, W sr^-1 m^-2.
template <class Real>
[[nodiscard]] Vec3<Real> environment_radiance(const EnvironmentTable& t, const EnvironmentPlaceOf<Real>& at) noexcept {
    using Int = IntOf<Real>;
    const Int below = at.row * Int(3 * (t.width + 1)) + at.column * Int(3);
    const auto texel = [&](std::int32_t offset) {
        const float* base = &t.texels->x + offset;
        return Vec3<Real>{gather(base, below), gather(base + 1, below), gather(base + 2, below)};
    };
    const std::int32_t next_row = 3 * (t.width + 1);
    const Real vx = Real(1.0f) - at.x, vy = Real(1.0f) - at.y;
    return (texel(0) * vx + texel(3) * at.x) * vy + (texel(next_row) * vx + texel(next_row + 3) * at.x) * at.y;
}

/// With which environment_direction draws a direction, per steradian.
template <class Real>
[[nodiscard]] Real environment_density(const EnvironmentTable& t, const EnvironmentPlaceOf<Real>& at) noexcept {
    const IntOf<Real> cell = at.row * IntOf<Real>(t.width + 1) + at.column;
    return to_real(gather(t.begin + 1, cell) - gather(t.begin, cell)) * gather(t.row_density, at.row);
}

KOKSMA_MATHS_END
#endif
