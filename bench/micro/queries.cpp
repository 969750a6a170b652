// Embree's queries as the kernels make them: rays copied into a packet, ids or visibilities read from it.

#include "render.h"
#include "scenes.h"

#include <koksma/sampling/bits.h>
#include <koksma/sampling/warps.h>
#include <koksma/scene/light_sampling.h>

#include <string>

namespace koksma::micro {

namespace {

constexpr std::size_t kRays = 16384;

float number(std::uint32_t what, std::size_t i) { return unit_float(keyed_hash({what, 7}, static_cast<std::uint32_t>(i))); }

struct Rays {
    std::vector<Ray> primary, secondary, shadow;
};

/// 16 camera rays through each pixel of a square in the middle of the film; from what they meet one ray by the cosine and one
/// to a point overhead.
Rays rays_of(const Scene& scene) {
    Rays out;
    const std::int32_t side = 32, x0 = (scene.film.width - side) / 2, y0 = (scene.film.height - side) / 2;
    for (std::size_t i = 0; i < kRays; ++i) {
        const auto pixel = static_cast<std::int32_t>(i / 16);
        const auto c = camera_ray<float>(scene.camera, film_point(scene.camera, x0 + pixel % side, y0 + pixel / side, {number(0, i), number(1, i)}), {});
        const Ray ray{c.o, c.d, c.t_near, c.t_far};
        out.primary.push_back(ray);
        const Hit hit = scene.accelerator.intersect(ray);
        if (!hit.valid()) continue;
        const Surface s = surface_at<EffectSet::all()>(scene, ray, hit);
        const Vec3f up = dot(s.ng, ray.d) < 0.0f ? s.ng : -s.ng;
        const Vec3f wi = Frame::from_normal(up).to_world(square_to_cosine_hemisphere(Vec2f{number(2, i), number(3, i)}));
        out.secondary.push_back({offset_origin(s.p, s.p_error, s.ng, wi), wi});
        const Vec3f lamp = Vec3f{0.0f, 1.1f, -5.2f} + Vec3f{number(4, i) - 0.5f, 0.0f, number(5, i) - 0.5f};  // below cornell's, seen from the camera
        const Vec3f o = offset_origin(s.p, s.p_error, s.ng, lamp - s.p);
        out.shadow.push_back({o, lamp - o, 0.0f, 1.0f});
    }
    return out;
}

void singles(benchmark::State& state, const Accelerator& accelerator, const std::vector<Ray>& rays, bool shadow) {
    for ([[maybe_unused]] auto iteration : state) {
        std::uint32_t sum = 0;
        if (shadow)
            for (const Ray& r : rays) sum += accelerator.occluded(r);
        else
            for (const Ray& r : rays) sum += accelerator.intersect(r).primitive;
        benchmark::DoNotOptimize(sum);
    }
    count(state, rays.size(), "per_ray");
}

template <int N>
void packets(benchmark::State& state, const Accelerator& accelerator, const std::vector<Ray>& rays, bool shadow, Coherence coherence) {
    RayPacket<N> p{};
    alignas(4 * N) std::int32_t valid[N];
    for (int i = 0; i < N; ++i) {
        p.mask[i] = ~0u;
        valid[i] = -1;
    }
    const std::size_t whole = rays.size() / N * N;
    for ([[maybe_unused]] auto iteration : state) {
        std::uint32_t sum = 0;
        for (std::size_t at = 0; at < whole; at += N) {
            for (int i = 0; i < N; ++i) {
                const Ray& r = rays[at + static_cast<std::size_t>(i)];
                p.o_x[i] = r.o.x;
                p.o_y[i] = r.o.y;
                p.o_z[i] = r.o.z;
                p.d_x[i] = r.d.x;
                p.d_y[i] = r.d.y;
                p.d_z[i] = r.d.z;
                p.t_near[i] = r.t_near;
                p.t_far[i] = r.t_far;
                p.geometry[i] = Hit::kNone;
            }
            if (shadow) {
                accelerator.occluded(p, valid, coherence);
                sum += p.t_far[0] < 0.0f;
            } else {
                accelerator.intersect(p, valid, coherence);
                sum += p.primitive[0];
            }
        }
        benchmark::DoNotOptimize(sum);
    }
    count(state, whole, "per_ray");
}

void add(const std::string& name, const Accelerator& accelerator, const std::vector<Ray>& rays, bool shadow) {
    benchmark::RegisterBenchmark((name + "/1/incoherent").c_str(), [&, shadow](benchmark::State& s) { singles(s, accelerator, rays, shadow); });
    for (const Coherence c : {Coherence::incoherent, Coherence::coherent}) {
        const std::string flag = c == Coherence::coherent ? "/coherent" : "/incoherent";
        benchmark::RegisterBenchmark((name + "/4" + flag).c_str(), [&, shadow, c](benchmark::State& s) { packets<4>(s, accelerator, rays, shadow, c); });
        benchmark::RegisterBenchmark((name + "/8" + flag).c_str(), [&, shadow, c](benchmark::State& s) { packets<8>(s, accelerator, rays, shadow, c); });
        benchmark::RegisterBenchmark((name + "/16" + flag).c_str(), [&, shadow, c](benchmark::State& s) { packets<16>(s, accelerator, rays, shadow, c); });
    }
}

}  // namespace

void register_queries() {
    static const Scene scenes[] = {cornell(), hills()};
    static const Rays rays[] = {rays_of(scenes[0]), rays_of(scenes[1])};
    constexpr const char* kNames[] = {"query/cornell", "query/hills"};
    for (std::size_t i = 0; i < 2; ++i) {
        const std::string name = kNames[i];
        add(name + "/primary", scenes[i].accelerator, rays[i].primary, false);
        add(name + "/secondary", scenes[i].accelerator, rays[i].secondary, false);
        add(name + "/shadow", scenes[i].accelerator, rays[i].shadow, true);
    }
}

}  // namespace koksma::micro
