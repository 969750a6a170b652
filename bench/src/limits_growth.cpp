#include "limits.h"
#include "spread.h"

#include <koksma/integrators/thread_clock.h>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <glm/common.hpp>

#include <chrono>
#include <cmath>
#include <ctime>
#include <fstream>
#include <string>

namespace koksma {

namespace {

using Json = nlohmann::ordered_json;

/// Largest resident memory of this process so far, in MB; 0 where the system does not say.
double peak_memory_mb() {
    std::ifstream in("/proc/self/status");
    for (std::string line; std::getline(in, line);)
        if (line.starts_with("VmHWM:")) return std::stod(line.substr(6)) / 1024.0;
    return 0.0;
}

/// CPU time of all threads.
double process_seconds() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

struct Cost {
    double seconds_per_path = 0.0, rays_per_path = 0.0;
};

/// One thread, repeated until the time can be believed.
Cost cost(const LimitsCommand& command, const SceneSetup& setup, std::uint64_t spp) {
    const auto source = setup.sampler->bind(sampling_plan(setup.scene, setup.plan, spp, setup.seed));
    RenderOptions o;
    o.threads = 1;
    if (!command.kernel.empty()) o.kernel = &find_kernel(command.kernel, setup.plan.effects);
    std::vector<double> seconds;
    double total = 0.0;
    Cost out;
    while (seconds.size() < 3 || (total < 0.2 && seconds.size() < 64)) {
        const RenderStats s = render(setup.scene, setup.plan, *source, {setup.rect(), 0, spp}, o).stats;
        seconds.push_back(s.cpu_seconds / static_cast<double>(s.paths));
        out.rays_per_path = static_cast<double>(s.rays.closest + s.rays.shadow) / static_cast<double>(s.paths);
        total += s.cpu_seconds;
        if (total > 20.0) break;
    }
    out.seconds_per_path = spread_of(seconds).median;
    return out;
}

/// Compiles the scene anew with a changed description.
void recompile(SceneSetup& setup, const SceneDescription& description) {
    const IntegratorSettings integrator = setup.plan.integrator;
    setup.scene = compile(description);
    setup.plan = make_plan(setup.scene, integrator);
}

/// The scene with a square film of this side.
void resize(SceneSetup& setup, int side) {
    FilmSettings& film = setup.scene.description.film;
    film = {side, side};
    film.crop_width = 0;
    recompile(setup, SceneDescription(setup.scene.description));
}

/// A description with n point lights more, spread evenly over the bounds of the scene's triangles.
SceneDescription with_lights(const Scene& scene, std::uint64_t n) {
    glm::dvec3 low(-1.0), high(1.0);
    if (!scene.triangles.empty()) {
        low = glm::dvec3(HUGE_VAL), high = -low;
        for (const auto& triangle : scene.triangles)
            for (const std::uint32_t v : triangle) {
                const glm::dvec3 p(scene.positions[v].x, scene.positions[v].y, scene.positions[v].z);
                low = glm::min(low, p), high = glm::max(high, p);
            }
        const glm::dvec3 origin(scene.description.camera.to_world[3]);  // of the scene's own coordinates
        low += origin, high += origin;
    }
    SceneDescription description = scene.description;
    for (std::uint64_t i = 0; i < n; ++i) {
        // Source: Roberts 2018, "The unreasonable effectiveness of quasirandom sequences" (R3: powers of 1 / 1.2207)
        const glm::dvec3 r = glm::fract(glm::dvec3(0.8191725134, 0.6710436067, 0.5497004779) * static_cast<double>(i) + 0.5);
        description.point_lights.push_back({low + (high - low) * r, Rgb(1.0f / static_cast<float>(n)), {}});
    }
    return description;
}

void print_row(std::uint64_t n, const Cost& c) {
    fmt::print("  {:>10}{:>14.0f}{:>12.3f}{:>16.1f}\n", n, c.seconds_per_path * 1e9, c.rays_per_path, peak_memory_mb());
}
Json json_row(const char* key, std::uint64_t n, const Cost& c) {
    return {
        {key, n}, {"cpu_ns_per_path", c.seconds_per_path * 1e9}, {"rays_per_path", c.rays_per_path}, {"peak_memory_mb", peak_memory_mb()}};
}

}  // namespace

Json measure_growth(const LimitsCommand& command, SceneSetup& setup) {
    Json figures;

    {
        const double cpu = process_seconds(), own = thread_seconds();
        const auto wall = std::chrono::steady_clock::now();
        setup.scene.accelerator.commit(!command.not_robust);
        const double wall_seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - wall).count();
        const double cpu_seconds = process_seconds() - cpu, own_seconds = thread_seconds() - own;
        fmt::print("  BVH: {:.3f} s of wall time, {:.3f} s of CPU time, {:.3f} s of them on the calling thread\n", wall_seconds,
                   cpu_seconds, own_seconds);
        figures["bvh"] = {{"wall_seconds", wall_seconds}, {"cpu_seconds", cpu_seconds}, {"calling_thread_seconds", own_seconds}};
    }

    constexpr int kSide = 32;
    resize(setup, kSide);
    fmt::print("  {:>10}{:>14}{:>12}{:>16}\n", "spp", "CPU ns/path", "rays/path", "peak memory MB");
    Json& by_spp = figures["spp"] = Json::array();
    for (std::uint64_t spp = 1; spp <= 65536; spp *= 4) {
        const Cost c = cost(command, setup, spp);
        print_row(spp, c);
        by_spp.push_back(json_row("spp", spp, c));
    }
    fmt::print("  {:>10}{:>14}{:>12}{:>16}\n", "pixels", "CPU ns/path", "rays/path", "peak memory MB");
    Json& by_pixels = figures["pixels"] = Json::array();
    for (int side = kSide; side <= 1024; side *= 2) {
        resize(setup, side);
        const Cost c = cost(command, setup, 4);
        const auto pixels = static_cast<std::uint64_t>(side) * static_cast<std::uint64_t>(side);
        print_row(pixels, c);
        by_pixels.push_back(json_row("pixels", pixels, c));
    }
    resize(setup, 2 * kSide);
    fmt::print("  {:>10}{:>14}{:>12}{:>16}\n", "lights", "CPU ns/path", "rays/path", "peak memory MB");
    Json& by_lights = figures["lights"] = Json::array();
    const Scene plain = compile(setup.scene.description);
    for (std::uint64_t more = 1; more <= 65536; more *= 4) {
        recompile(setup, with_lights(plain, more));
        const Cost c = cost(command, setup, 16);
        print_row(setup.scene.lights.size(), c);
        by_lights.push_back(json_row("lights", setup.scene.lights.size(), c));
    }
    return figures;
}

}  // namespace koksma
