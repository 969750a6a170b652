// Directions drawn from an environment map: by inversion of its rows', then of a row's columns' prefix sums.
//
// Probabilities are whole parts of 2^30: what a table says is then exactly what is drawn, for floats and for packs, and the density is
// computed from the same parts. Every cell that is not black gets one part at least.

#include <koksma/math/vec3.h>
#include <koksma/sampling/bits.h>
#include <koksma/simd/elementary.h>

#include <bit>
#include <cstdint>

#if defined(KOKSMA_SCENE_ENVIRONMENT_DIRECTION_H) == defined(KOKSMA_MATHS_TOGGLE)
#ifdef KOKSMA_SCENE_ENVIRONMENT_DIRECTION_H
#undef KOKSMA_SCENE_ENVIRONMENT_DIRECTION_H
#else
#define KOKSMA_SCENE_ENVIRONMENT_DIRECTION_H
#endif

#ifdef KOKSMA_ORDINARY
namespace koksma {

inline constexpr std::int32_t kWhole = 1 << 30;

/// Discrete distributions, as many as there are rows.
struct InversionTable {
    std::int32_t entries = 0, parts = 0;  ///< in a row; the guide's parts are a power of two
    const float* begin = nullptr;         ///< (rows, entries + 1), kStep apart: bits of the integer in [0, kWhole] at which each entry begins
    const std::int32_t* guide = nullptr;  ///< (rows, parts + 1): the entry at the beginning of each of as many equal parts
};

/// How many parts the guide of so many entries has.
[[nodiscard]] constexpr std::int32_t guide_parts(std::int32_t entries) noexcept {
    return static_cast<std::int32_t>(std::bit_ceil(static_cast<std::uint32_t>(entries)));
}

/// What drawing a direction reads.
struct EnvironmentCells {
    InversionTable rows, columns;       ///< one row of rows; a row of columns for each, which begin in the texels that are read next
    const float* half_sine2 = nullptr;  ///< sin^2(theta / 2) where each row of cells begins, and where the last one ends
    Vec3f axis_x, axis_y, axis_z;       ///< rows of world-to-map
};

}  // namespace koksma
#endif

KOKSMA_MATHS_BEGIN

template <class Real>
struct InversionSampleOf {
    IntOf<Real> index;
    Real u;  ///< what is left of the number, in [0, 1)
};

/// Constant time on average.
/// Source: Chen and Asau 1974, "On generating random variates from an empirical distribution" (the guide table)
template <int kStep, class Real>
[[nodiscard]] InversionSampleOf<Real> invert(const InversionTable& t, IntOf<Real> row, Real u) noexcept {
    using Int = IntOf<Real>;
    const Int x = to_int(u * Real(static_cast<float>(kWhole))),
              part = row * Int(t.parts + 1) + to_int(u * Real(static_cast<float>(t.parts)));
    const Int first = row * Int(t.entries + 1);
    const auto begin_of = [&](Int entry) { return bits_of(gather(t.begin, (first + entry) * Int(kStep))); };
    // The last entry that begins at x or before: those of no width are passed over.
    Int low = gather(t.guide, part), high = gather(t.guide + 1, part);
    while (any(low < high)) {
        const Int middle = shift_right<1>(low + high + Int(1));
        const auto beyond = begin_of(middle) > x;
        low = select(beyond, low, middle);
        high = select(beyond, middle - Int(1), high);
    }
    const Int begin = begin_of(low), width = begin_of(low + Int(1)) - begin;
    const Real rest = to_real(x - begin) / to_real(width);
    return {low, select(rest < Real(kOneMinusUlp), rest, Real(kOneMinusUlp))};
}

/// A direction, unit, world space; environment_at has its density. @pre the map is not black
template <class Real>
[[nodiscard]] Vec3<Real> environment_direction(const EnvironmentCells& cells, Vec2<Real> u) noexcept {
    using Int = IntOf<Real>;
    const InversionSampleOf<Real> row = invert<1>(cells.rows, Int(0), u.y);
    const InversionSampleOf<Real> column = invert<4>(cells.columns, row.index, u.x);
    // Uniform in solid angle within the cell: linear in azimuth and in the cosine, 1 - 2 sin^2(theta / 2). By the poles of a large map
    // a row of cells spans only a few floats of the cosine: so squares of half angles, from the nearer pole.
    const Int count(cells.rows.entries);
    const auto north = row.index + row.index < count;
    const Int from = select(north, row.index, count - row.index), to = select(north, row.index + Int(1), count - row.index - Int(1));
    const Real s0 = gather(cells.half_sine2, from), s1 = gather(cells.half_sine2, to);
    const Real s = s0 + (s1 - s0) * row.u;
    const Real height = Real(1.0f) - Real(2.0f) * s, cos_theta = select(north, height, -height),
               sin_theta = Real(2.0f) * sqrt(s * (Real(1.0f) - s));
    const SinCosOf<Real> phi =
        sincos_turns((to_real(column.index) + column.u + Real(0.5f)) / Real(static_cast<float>(cells.columns.entries)));
    return Vec3<Real>::splat(cells.axis_x) * (sin_theta * phi.sin) + Vec3<Real>::splat(cells.axis_y) * cos_theta -
           Vec3<Real>::splat(cells.axis_z) * (sin_theta * phi.cos);
}

KOKSMA_MATHS_END
#endif
