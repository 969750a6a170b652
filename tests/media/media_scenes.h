#pragma once
// Media in the few words that tests need.

#include <scenes/render_scene.h>

namespace koksma::testing {

[[nodiscard]] inline Medium homogeneous(Rgb sigma_t, Rgb albedo, double g = 0.0) {
    Medium m;
    m.sigma_t = ConstantVolume{sigma_t, Matrix(1.0)};
    m.albedo = ConstantVolume{albedo, Matrix(1.0)};
    m.g = g;
    return m;
}
/// The same as a grid over a box that is `to_world` of the unit cube.
[[nodiscard]] inline Medium heterogeneous(std::shared_ptr<const VolumeGrid> sigma_t, const Matrix& to_world, Rgb albedo, double g = 0.0) {
    Medium m = homogeneous(Rgb(1.0f), albedo, g);
    m.heterogeneous = true;
    GridVolume v;
    v.grid = std::move(sigma_t);
    v.to_world = to_world;
    m.sigma_t = v;
    return m;
}
[[nodiscard]] inline SceneDescription volume_scene(std::int32_t max_depth = -1) {
    SceneDescription d = empty_scene();
    d.integrator.volumetric = true;
    d.integrator.max_depth = max_depth;
    return d;
}
/// A shape of nothing with a medium inside.
inline Shape& add_medium(SceneDescription& d, Medium m, Geometry geometry, const Matrix& to_world) {
    d.media.push_back(std::move(m));
    const std::uint32_t nothing = add_material(d, Null{});
    Shape& s = add_shape(d, std::move(geometry), to_world, nothing);
    s.interior = static_cast<std::uint32_t>(d.media.size() - 1);
    return s;
}

/// Mean colour with the noise of its replicates.
struct MeasuredRgb {
    Measured channel[3];
};
[[nodiscard]] inline MeasuredRgb measure_rgb(const SceneDescription& d, std::uint64_t spp, int replicates = 8,
                                             std::string_view sampler = kSobol) {
    const Ready ready(d);
    std::vector<double> means[3];
    std::uint64_t invalid = 0;
    for (int r = 0; r < replicates; ++r) {
        const RenderResult result = ready.render(sampler, spp, static_cast<std::uint64_t>(r) + 1);
        const Vec3d m = result.film.mean();
        means[0].push_back(m.x), means[1].push_back(m.y), means[2].push_back(m.z);
        invalid += result.stats.invalid_samples;
    }
    return {{measured(means[0], invalid), measured(means[1], invalid), measured(means[2], invalid)}};
}

}  // namespace koksma::testing
