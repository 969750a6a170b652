// Whole paths by each kernel variant, and what the film does with their radiance.

#include "render.h"
#include "scenes.h"

#include <koksma/film/film.h>
#include <koksma/integrators/render.h>
#include <koksma/sampling/registry.h>

#include <memory>
#include <string>
#include <vector>

namespace koksma::micro {

namespace {

struct Setup {
    Scene scene = cornell();
    RenderPlan plan = make_plan(scene, scene.description.integrator);
    std::unique_ptr<SampleSource> source;
    std::vector<SampleId> ids;  ///< 64 samples of each of 64 pixels in the middle

    Setup() {
        Registry registry;
        register_samplers(registry);
        source = registry.make("sobol:randomize=owen")->bind(sampling_plan(scene, plan, 64, 1));
        for (std::int32_t pixel = 0; pixel < 64; ++pixel)
            for (std::uint64_t i = 0; i < 64; ++i) ids.push_back({{124 + pixel % 8, 124 + pixel / 8}, i});
    }
};

void trace(benchmark::State& state, const Setup& setup, const Kernel& kernel) {
    const std::unique_ptr<Tracer> tracer = kernel.make({setup.scene, setup.plan, *setup.source});
    if (tracer == nullptr) {
        state.SkipWithError("this CPU lacks what the kernel needs");
        return;
    }
    std::vector<Vec3f> radiance(setup.ids.size());
    for ([[maybe_unused]] auto iteration : state) {
        for (std::size_t at = 0; at < setup.ids.size(); at += kernel.batch) {
            const std::size_t n = std::min(kernel.batch, setup.ids.size() - at);
            tracer->trace(std::span(setup.ids).subspan(at, n), std::span(radiance).subspan(at, n));
        }
        benchmark::DoNotOptimize(radiance.data());
        benchmark::ClobberMemory();
    }
    count(state, setup.ids.size(), "per_path");
}

void film_add(benchmark::State& state) {
    Film film({0, 0, 64, 64});
    std::vector<Vec3f> radiance(static_cast<std::size_t>(state.range(0)));
    for (std::size_t i = 0; i < radiance.size(); ++i) radiance[i] = Vec3f(0.3f + 0.01f * static_cast<float>(i));
    for ([[maybe_unused]] auto iteration : state)
        for (std::int32_t y = 0; y < 64; ++y)
            for (std::int32_t x = 0; x < 64; ++x) film.add({x, y}, radiance);
    count(state, 64 * 64 * radiance.size(), "per_sample");
}

void film_image(benchmark::State& state) {
    Film film({0, 0, 256, 256});
    for ([[maybe_unused]] auto iteration : state) benchmark::DoNotOptimize(film.image());
    count(state, 256 * 256, "per_pixel");
}

}  // namespace

void register_kernels() {
    static const Setup setup;
    for (const Kernel& kernel : kernels())
        if (kernel.effects.contains(setup.plan.effects))
            benchmark::RegisterBenchmark(("kernel/cornell/" + std::string(kernel.name)).c_str(), [&kernel](benchmark::State& s) { trace(s, setup, kernel); });
    benchmark::RegisterBenchmark("film/add", film_add)->Arg(1)->Arg(4)->Arg(64);
    benchmark::RegisterBenchmark("film/image", film_image);
}

}  // namespace koksma::micro
