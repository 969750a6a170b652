#include <koksma/scene/bsdf/rough_plastic.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace koksma {

namespace {

/// In the plane of slopes, by midpoints: the radius in units of alpha as r = t / (1 - t), for distributions have no end, the azimuth evenly.
/// The shares are then within 1e-3 of a Monte Carlo estimate, and of Mitsuba 3.
constexpr int kRadii = 96, kAzimuths = 48;

}  // namespace

RoughShares rough_shares(const Microfacet& facets, float cosine, float eta) {
    const Vec3f wo{std::sqrt(std::max(0.0f, 1.0f - cosine * cosine)), 0.0f, cosine};
    double reflected = 0, transmitted = 0, visible = 0;
    for (int i = 0; i < kRadii; ++i) {
        const double t = (i + 0.5) / kRadii, r = t / (1.0 - t), dr = 1.0 / ((1.0 - t) * (1.0 - t));
        for (int j = 0; j < kAzimuths; ++j) {
            const double phi = std::numbers::pi * (j + 0.5) / kAzimuths;  // the other half is the same
            const double x = double{facets.alpha_u} * r * std::cos(phi), y = double{facets.alpha_v} * r * std::sin(phi);
            const Vec3f h = normalize(Vec3f{static_cast<float>(x), static_cast<float>(y), 1.0f});
            const float c = dot(wo, h);
            if (!(c > 0.0f)) continue;
            const double cos_h = double{h.z}, weight = double{facets.d(h)} * cos_h * cos_h * cos_h * r * dr * double{c};  // dh = cos^3 dx dy
            visible += weight;
            const FacetRefraction f = facet_refraction(eta, true, c);
            const Vec3f up = h * (2.0f * c) - wo;
            if (up.z > 0.0f) reflected += weight * double{f.reflectance * facets.g1(up, h)};
            if (!(f.reflectance < 1.0f)) continue;
            const Vec3f down = (h * f.bend - wo) * (1.0f / f.eta);
            if (down.z < 0.0f) transmitted += weight * double{(1.0f - f.reflectance) * facets.g1(down, h)};
        }
    }
    if (!(visible > 0.0)) return {1.0f, 0.0f};
    return {static_cast<float>(reflected / visible), static_cast<float>(transmitted / visible)};
}

void tabulate(RoughPlasticBsdf& b) {
    const std::size_t n = b.through.node.size();
    double inner = 0;
    for (std::size_t i = 0; i < n; ++i) {
        const float mu = std::max(1e-6f, static_cast<float>(i) / static_cast<float>(n - 1));
        b.through.node[i] = rough_shares(b.facets, mu, b.base.eta).transmitted;
        inner += double{rough_shares(b.facets, mu, 1.0f / b.base.eta).reflected * mu};
    }
    b.base.inner_reflectance = static_cast<float>(2.0 * inner / static_cast<double>(n));
}

}  // namespace koksma
