#pragma once
// What a kernel makes of every sample of a film: radiance, and the hash of what the path met.

#include <effects/effect_scenes.h>
#include <scenes/render_scene.h>

#include <koksma/integrators/float_mode.h>
#include <koksma/scene/load.h>
#include <koksma/simd/targets.h>

#include <algorithm>
#include <cstring>
#include <filesystem>

namespace koksma::testing {

struct NamedScene {
    std::string name;
    SceneDescription description;
};

/// A height field of 8192 small triangles, since kernels differ at edges if anywhere; diffuse, or in stripes of glass and of that.
[[nodiscard]] inline SceneDescription hills(bool glass) {
    constexpr int kSide = 64;
    std::vector<glm::vec3> vertices;
    std::vector<std::array<std::uint32_t, 3>> triangles, stripes;
    for (int z = 0; z <= kSide; ++z)
        for (int x = 0; x <= kSide; ++x) {
            const float u = 4.0f * static_cast<float>(x) / kSide - 2.0f, v = 4.0f * static_cast<float>(z) / kSide - 2.0f;
            vertices.push_back({u, 0.3f + 0.15f * std::sin(7.0f * u) * std::cos(9.0f * v), v});
        }
    for (std::uint32_t z = 0; z < kSide; ++z)
        for (std::uint32_t x = 0; x < kSide; ++x) {
            const std::uint32_t a = z * (kSide + 1) + x, b = a + kSide + 1;
            auto& to = glass && (x + z) / 4 % 2 == 0 ? stripes : triangles;
            to.push_back({a, b, a + 1});
            to.push_back({a + 1, b, b + 1});
        }
    SceneDescription d = floor_scene();
    if (glass) {
        const std::uint32_t material = add_material(d, Dielectric{});
        add_shape(d, mesh(vertices, std::move(stripes)), Matrix(1.0), material);
    }
    add_shape(d, mesh(std::move(vertices), std::move(triangles)), Matrix(1.0), 0);
    d.integrator.max_depth = 8;
    return d;
}

/// All built-in scenes, one scene for each effect, some of many triangles or of instances that move, with films of about 2000 pixels.
[[nodiscard]] inline std::vector<NamedScene> kernel_scenes() {
    std::vector<NamedScene> out;
    std::vector<std::filesystem::path> files;
    for (const auto& entry : std::filesystem::directory_iterator(std::filesystem::path(KOKSMA_SOURCE_DIR) / "scenes"))
        if (entry.path().extension() == ".xml") files.push_back(entry.path());
    std::sort(files.begin(), files.end());
    for (const auto& file : files) out.push_back({file.stem().string(), load_scene(file, {{"res", "45"}})});
    const auto add = [&](std::string name, SceneDescription d) {
        d.film.width = 51;
        d.film.height = 39;
        out.push_back({std::move(name), std::move(d)});
    };
    for (EffectScene& s : effect_scenes()) {
        if (s.effect == Effect::motion) {
            SceneDescription mirrored = s.description;
            std::vector<Shape>& group = mirrored.groups[0].shapes;
            group[1].material = add_material(mirrored, Dielectric{});
            group[2].material = add_material(mirrored, Conductor{});
            add("moving glass and mirrors", std::move(mirrored));
        }
        add("effect " + std::string(name(s.effect)), std::move(s.description));
    }
    add("hills", hills(false));
    add("hills with glass", hills(true));
    return out;
}

[[nodiscard]] inline bool is_batch(const Kernel& kernel) { return kernel.name.starts_with("batch/"); }

/// The admissible kernels of one family, smallest first.
[[nodiscard]] inline std::vector<const Kernel*> family(EffectSet needed, bool batch) {
    std::vector<const Kernel*> out;
    for (const Kernel& k : kernels())
        if (k.effects.contains(needed) && is_batch(k) == batch) out.push_back(&k);
    return out;
}

/// Runs the whole process on one instruction set while alive.
class Target {
public:
    explicit Target(const std::string& name) { simd::use_target(name); }
    ~Target() { simd::use_target(""); }
    Target(const Target&) = delete;
    Target& operator=(const Target&) = delete;
};

struct Traced {
    std::vector<Vec3f> radiance;
    std::vector<std::uint64_t> hashes;
    RayCounts rays;
};

/// All samples of the film, pixel after pixel, `spp` of each.
/// @param at_once  how many samples go to the kernel together; 0: as many as it wants
[[nodiscard]] inline Traced trace_all(const Ready& ready, const Kernel& kernel, std::uint64_t spp, std::uint64_t seed, std::size_t at_once = 0) {
    const FlushDenormals flush;
    const auto source = samplers().make(kSobol)->bind(sampling_plan(ready.scene, ready.plan, spp, seed));
    std::vector<SampleId> ids;
    const PixelRect rect = crop_of(ready.scene.film);
    for (std::int32_t y = rect.y; y < rect.y + rect.height; ++y)
        for (std::int32_t x = rect.x; x < rect.x + rect.width; ++x)
            for (std::uint64_t i = 0; i < spp; ++i) ids.push_back({{x, y}, i});
    Traced out{std::vector<Vec3f>(ids.size()), std::vector<std::uint64_t>(ids.size()), {}};
    const std::unique_ptr<Tracer> tracer = kernel.make({ready.scene, ready.plan, *source});
    const std::size_t step = at_once == 0 ? kernel.batch : at_once;
    for (std::size_t at = 0; at < ids.size(); at += step) {
        const std::size_t n = std::min(step, ids.size() - at);
        tracer->trace(std::span(ids).subspan(at, n), std::span(out.radiance).subspan(at, n), std::span(out.hashes).subspan(at, n));
    }
    out.rays = tracer->stats().rays;
    return out;
}

/// How two kernels compare, path by path.
struct Agreement {
    std::uint64_t paths = 0;
    std::uint64_t met_something_else = 0;        ///< hashes differ
    std::uint64_t same_way_other_radiance = 0;   ///< hashes agree, bytes of the radiance do not
};

[[nodiscard]] inline Agreement compare(const Traced& a, const Traced& b) {
    Agreement out;
    out.paths = a.radiance.size();
    for (std::size_t i = 0; i < a.radiance.size(); ++i) {
        if (a.hashes[i] != b.hashes[i])
            ++out.met_something_else;
        else if (std::memcmp(&a.radiance[i], &b.radiance[i], sizeof(Vec3f)) != 0)
            ++out.same_way_other_radiance;
    }
    return out;
}

}  // namespace koksma::testing
