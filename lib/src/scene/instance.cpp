#include <koksma/scene/instance.h>
#include <koksma/scene/surface.h>

#include <cmath>

namespace koksma {

Transfer transfer_at(const Scene& scene, const InstanceRecord& instance, float time) noexcept {
    const Placement* placements = &scene.placements[instance.first_placement];
    if (instance.placement_count == 1) return {placements[0], instance.to_own};
    const std::uint32_t pieces = instance.placement_count - 1;
    const float scaled = time * static_cast<float>(pieces), whole = std::floor(scaled);
    const std::uint32_t piece = whole < static_cast<float>(pieces) ? static_cast<std::uint32_t>(whole) : pieces - 1;
    const Placement now = between(placements[piece], placements[piece + 1], static_cast<double>(scaled) - piece);
    return {now, inverse(now)};
}

Surface detail::instanced_surface_at(const Scene& scene, const Ray& ray, Hit hit) noexcept {
    const InstanceRecord& instance = scene.instances[hit.instance];
    const Transfer transfer = transfer_at(scene, instance, ray.time);
    const Ray own{to_float(point_by(transfer.to_own, to_double(ray.o))), to_float(vector_by(transfer.to_own, to_double(ray.d))), ray.t_near,
                  ray.t_far};
    Surface s = own_surface_at<EffectSet::all(), true>(scene, own, hit);
    const auto unit = [&](Vec3f n) {
        const Vec3d v = normal_by_inverse(transfer.to_own, to_double(n));
        return to_float(v * (1.0 / std::sqrt(dot(v, v))));
    };
    const Vec3d p = point_by(transfer.to_scene, to_double(s.p));
    s.p = to_float(p);
    s.p_error = to_float(bound_by(transfer.to_scene, to_double(s.p_error)) + instance.error.at(p)) + abs(s.p) * error_gamma(1);
    const bool one_normal = s.n == s.ng;
    s.ng = unit(s.ng);
    s.n = one_normal ? s.ng : unit(s.n);
    s.dpdu = to_float(vector_by(transfer.to_scene, to_double(s.dpdu)));
    s.instance = hit.instance;
    s.time = ray.time;
    return s;
}

}  // namespace koksma
