// The smallest use of Koksma as a library: a scene, a sampler, a render.
// Usage: minimal SCENE.xml [SAMPLER [SPP]]

#include <koksma/integrators/render.h>
#include <koksma/sampling/registry.h>
#include <koksma/scene/load.h>

#include <cstdio>
#include <cstdlib>

int main(int argc, char** argv) try {
    if (argc < 2) {
        std::fprintf(stderr, "usage: minimal SCENE.xml [SAMPLER [SPP]]\n");
        return 2;
    }
    const char* sampler = argc > 2 ? argv[2] : "sobol:randomize=owen";
    const std::uint64_t spp = argc > 3 ? std::strtoull(argv[3], nullptr, 10) : 16;

    // A scene file becomes plain values, then something that can be rendered.
    const koksma::SceneDescription description = koksma::load_scene(argv[1]);
    const koksma::Scene scene = koksma::compile(description);

    // What the scene calls for decides which random numbers a path has.
    const koksma::RenderPlan plan = koksma::make_plan(scene, description.integrator);

    // A sampler is found by name and bound to the plan: here seed 1, spp samples a pixel.
    koksma::Registry registry;
    koksma::register_samplers(registry);
    const auto source = registry.make(sampler)->bind(koksma::sampling_plan(scene, plan, spp, 1));

    const koksma::RenderResult result = koksma::render(scene, plan, *source, {koksma::crop_of(scene.film), 0, spp});

    const koksma::Vec3d mean = result.film.mean();
    std::printf("%s: mean %.6f %.6f %.6f, %llu paths, %.0f ns of CPU time a path\n", sampler, mean.x, mean.y, mean.z,
                static_cast<unsigned long long>(result.stats.paths), 1e9 * result.stats.cpu_seconds / static_cast<double>(result.stats.paths));
    return 0;
} catch (const koksma::Error& e) {
    std::fprintf(stderr, "minimal: %s\n", e.what());
    return 1;
}
