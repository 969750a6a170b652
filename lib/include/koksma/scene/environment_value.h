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
    std::int32_t width = 0, height = 0;  ///< cells per row (wrapping), rows of texels
    /// (height, width + 1, 4): the first column is repeated at the end. Red, green, blue; and the bits of the integer at which the part of
    /// the cell to the right and below begins in its row (environment_direction.h).
    const float* texels = nullptr;
    const float* row_density = nullptr;  ///< (height - 1): density per steradian of a cell that has one part
    Vec3f axis_x, axis_y, axis_z;        ///< rows of world-to-map
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

template <class Real>
struct EnvironmentValueOf {
    Vec3<Real> radiance;  ///< W sr^-1 m^-2
    Real pdf_w;           ///< with which environment_direction draws the direction, per steradian
};

template <class Real>
[[nodiscard]] EnvironmentValueOf<Real> environment_at(const EnvironmentTable& t, const EnvironmentPlaceOf<Real>& at) noexcept {
    const IntOf<Real> cell = at.row * IntOf<Real>(t.width + 1) + at.column;
    Real above[8], below[8];  // two texels side by side
    load_rows(t.texels, 4, cell, above);
    load_rows(t.texels, 4, cell + IntOf<Real>(t.width + 1), below);
    const auto between = [&](const Real(&two)[8]) {
        return Vec3<Real>{two[0], two[1], two[2]} * (Real(1.0f) - at.x) + Vec3<Real>{two[4], two[5], two[6]} * at.x;
    };
    const Real density = to_real(bits_of(above[7]) - bits_of(above[3])) * gather(t.row_density, at.row);
    return {between(above) * (Real(1.0f) - at.y) + between(below) * at.y, density};
}

KOKSMA_MATHS_END
#endif
