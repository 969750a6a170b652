#pragma once
// Distances and transmittances in media whose extinction may be coloured.
//
// A path has one density for each colour channel: that of tracking by the channel's extinction alone. Every decision here is made by the
// mean of the three, given all decisions before; so a path comes with the density that spectral MIS by the balance heuristic would weight
// it with (Miller, Georgiev and Jarosz 2019, "A null-scattering path integral formulation of light transport", eq. 18), and no channel
// is drawn. In a heterogeneous medium the collisions with what is missing to the majorant, which scatter nothing, belong to the path.

#include <koksma/sampling/bits.h>
#include <koksma/scene/medium/medium_record.h>
#include <koksma/simd/elementary.h>

#include <cmath>
#include <utility>

namespace koksma {

/// What a path is worth by colour.
struct PathWeight {
    Vec3f beta{1.0f};   ///< value over density, of the path so far
    Vec3f share{1.0f};  ///< density of each channel over their mean
    /// Probability, since the last vertex, of all that would be no decision for light sampling: it crosses what it meets.
    float way = 1.0f;

    /// The mean probability of what has the probabilities or densities `q` by channel.
    [[nodiscard]] float mean(Vec3f q) const noexcept { return (share.x * q.x + share.y * q.y + share.z * q.z) * (1.0f / 3.0f); }
    /// Takes in an event of value f and densities q. @param m  mean(q), positive
    void take(Vec3f f, Vec3f q, float m) noexcept {
        beta *= f * (1.0f / m);
        share *= q * (1.0f / m);
    }
};

/// exp(-sigma_t distance). @param distance  may be infinite
[[nodiscard]] inline Vec3f beam_transmittance(const MediumRecord& medium, float distance) noexcept {
    const auto along = [&](float sigma) {
        const float depth = sigma * distance;
        return sigma > 0.0f ? (depth < 87.0f ? exp_poly(-depth) : 0.0f) : 1.0f;
    };
    const float x = along(medium.sigma_t.x);
    return medium.grey ? Vec3f(x) : Vec3f{x, along(medium.sigma_t.y), along(medium.sigma_t.z)};
}

/// The distance in a homogeneous medium at which the mean transmittance of the channels has fallen to `v`.
/// @param v  in (0, 1], above what it falls to
/// Newton's method on the logarithm, which is convex and decreasing: from 0 it comes nearer without passing by, and in one step if all is
/// grey.
[[nodiscard]] inline float distance_to(const MediumRecord& medium, const PathWeight& weight, float v) noexcept {
    const float log_v = log_poly(v);
    if (medium.grey) return -log_v / medium.sigma_t.x;
    float t = 0.0f;
    for (int i = 0; i < 64; ++i) {
        const Vec3f tr = beam_transmittance(medium, t);
        const float s = weight.mean(tr), slope = weight.mean(tr * medium.sigma_t);
        if (!(s > 0.0f && slope > 0.0f)) break;
        const float next = t + (log_poly(s) - log_v) * s / slope;
        if (!(next > t * (1.0f + 0x1p-21f))) break;
        t = next;
    }
    return t;
}

/// A collision with a medium's particles.
struct Collision {
    bool happened = false;
    Vec3f p;
};

/// The numbers that decide on the way to a vertex. Each is stretched by what it decided, so it decides again.
struct WayNumbers {
    float survival = 1.0f;   ///< (0, 1]: the path comes as far as its transmittance is above it
    float collision = 0.0f;  ///< [0, 1): which collision is real
    float passage = 0.0f;    ///< [0, 1): which surface stops the path
};

/// From o + near d to o + far d through a homogeneous medium, or to where it scatters.
/// @param d  unit
[[nodiscard]] inline Collision fly_homogeneous(const MediumRecord& medium, Vec3f o, Vec3f d, float near, float far, PathWeight& weight,
                                               WayNumbers& u) noexcept {
    const Vec3f through = beam_transmittance(medium, far - near);
    const float m = weight.mean(through);
    if (u.survival <= m) {
        u.survival /= m;
        if (!medium.grey) weight.take(through, through, m);
        weight.way *= m;
        return {};
    }
    float t = distance_to(medium, weight, u.survival);
    t = t < far - near ? t : far - near;
    const Vec3f p = o + d * (near + t);
    const Vec3f albedo = value_at(medium.albedo, p);
    if (medium.grey) {
        weight.beta *= albedo;
    } else {
        const Vec3f q = medium.sigma_t * beam_transmittance(medium, t);
        weight.take(q * albedo, q, weight.mean(q));
    }
    return {true, p};
}

/// The part of [near, far] within a box. @return  false if there is none
[[nodiscard]] inline bool clip(Vec3f low, Vec3f high, Vec3f o, Vec3f d, float& near, float& far) noexcept {
    const auto axis = [&](float lo, float hi, float origin, float direction) {
        if (direction == 0.0f) {
            if (origin < lo || origin > hi) far = -1.0f;
            return;
        }
        float a = (lo - origin) / direction, b = (hi - origin) / direction;
        if (a > b) std::swap(a, b);
        near = a > near ? a : near;
        far = b < far ? b : far;
    };
    axis(low.x, high.x, o.x, d.x);
    axis(low.y, high.y, o.y, d.y);
    axis(low.z, high.z, o.z, d.z);
    return near < far;
}

/// The extinction over the majorant; rounding may have put an interpolated value above it.
[[nodiscard]] inline Vec3f real_part(const MediumRecord& medium, Vec3f p) noexcept {
    const Vec3f part = value_at(medium.density, p) * (medium.scale / medium.majorant);
    return {part.x < 1.0f ? part.x : 1.0f, part.y < 1.0f ? part.y : 1.0f, part.z < 1.0f ? part.z : 1.0f};
}

/// As fly_homogeneous, by delta tracking: collisions as dense as the majorant, of which a part is real.
/// @param next  () -> [0, 1): a fresh number, for each distance after the first
/// Source: Woodcock et al. 1965, "Techniques used in the GEM code for Monte Carlo neutronics calculations"
template <class Next>
[[nodiscard]] Collision fly_heterogeneous(const MediumRecord& medium, Vec3f o, Vec3f d, float near, float far, PathWeight& weight,
                                          WayNumbers& u, Next&& next) noexcept {
    if (!clip(medium.low, medium.high, o, d, near, far)) return {};
    for (;;) {
        const float t = near - log_poly(u.survival) / medium.majorant;
        if (!(t < far)) {
            const float through = exp_poly(-medium.majorant * (far - near));
            u.survival = u.survival < through ? u.survival / through : 1.0f;
            return {};
        }
        near = t;
        const Vec3f p = o + d * t;
        const Vec3f real = real_part(medium, p);
        const Vec3f null = Vec3f(1.0f) - real;
        const float chance = weight.mean(real), m = weight.mean(null);
        if (u.collision < chance || !(m > 0.0f)) {
            weight.take(real * value_at(medium.albedo, p), real, chance);
            return {true, p};
        }
        u.collision = (u.collision - chance) / (1.0f - chance);
        u.collision = u.collision < kOneMinusUlp ? u.collision : kOneMinusUlp;
        weight.take(null, null, m);
        weight.way *= m;
        u.survival = 1.0f - next();
    }
}

/// Transmittance of a heterogeneous medium, by ratio tracking: the mean of what these numbers give is the transmittance. Also the density
/// of delta tracking, over that of these collisions, to come through.
/// @param next  () -> [0, 1): a fresh number for each distance
/// Source: Novak, Selle and Jarosz 2014, "Residual ratio tracking for estimating attenuation in participating media", section 2.3
template <class Next>
[[nodiscard]] Vec3f track_transmittance(const MediumRecord& medium, Vec3f o, Vec3f d, float near, float far, Next&& next) noexcept {
    Vec3f out{1.0f};
    if (!clip(medium.low, medium.high, o, d, near, far)) return out;
    for (;;) {
        near -= log_poly(1.0f - next()) / medium.majorant;
        if (!(near < far)) return out;
        out *= Vec3f(1.0f) - real_part(medium, o + d * near);
        if (!(max_component(out) > 0.0f)) return Vec3f{0.0f};
    }
}

}  // namespace koksma
