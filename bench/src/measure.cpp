#include "measure.h"

#include "machine.h"

#include <koksma/measure/seeds.h>

#include <fmt/format.h>

#include <algorithm>
#include <string>

namespace koksma {

namespace {

/// Asks a source that can say it how it fills its numbers.
template <class Source>
std::string fill_of(const Source& source) {
    if constexpr (requires { static_cast<bool>(source.vectorised()); })
        return source.vectorised() ? "vector" : "scalar";
    else
        return "unstated";
}

}  // namespace

std::uint64_t seed_of(const BenchScene& s, const SamplerFactory& sampler, const Trial& trial, std::uint64_t base_seed) {
    std::uint64_t base = trial.layout == 0 ? base_seed : hash_combine(base_seed, static_cast<std::uint64_t>(trial.layout));
    constexpr std::uint64_t kPrefixes = 0x7072656669786573;  // a render that is read at its prefixes is none of the native ones
    if (trial.prefix_of > 0) base = hash_combine(base_seed, kPrefixes);
    return test_seed(base, s.key.scene_hash, sampler.name(), trial.prefix_of > 0 ? trial.prefix_of : trial.spp,
                     static_cast<std::uint64_t>(trial.replicate));
}

Row identity_of(const BenchScene& s, const SamplerFactory& sampler, const Judge& judge, const Trial& trial, std::uint64_t base_seed, int threads) {
    static const Machine kMachine = machine();
    Row row;
    row.scene = s.what.name;
    row.scene_hash = fmt::format("{:016x}", s.key.scene_hash);
    row.sampler = sampler.name();
    row.sampler_version = sampler.info().version;
    row.randomized = sampler.randomized();
    row.spp = trial.spp;
    row.seed = seed_of(s, sampler, trial, base_seed);
    row.replicate = trial.replicate;
    row.layout = trial.layout;
    row.prefix_of = trial.prefix_of;
    row.film[0] = s.scene.film.width;
    row.film[1] = s.scene.film.height;
    const int crop[4] = {s.what.crop.x, s.what.crop.y, s.what.crop.width, s.what.crop.height};
    std::copy(crop, crop + 4, row.crop);
    row.max_depth = s.plan.integrator.max_depth;
    row.rr_depth = s.plan.integrator.rr_depth;
    row.effects = s.plan.effects.names();
    row.dimensions = s.plan.layout.dimensions();
    row.threads = threads > 0 ? threads : kMachine.cores;
    row.estimator_version = kEstimatorVersion;
    row.reference = s.key.digest();
    row.reference_content = judge.content();
    row.commit = commit();
    row.machine = kMachine.cpu;
    row.isa = kMachine.isa;
    return row;
}

Row measure(const BenchScene& s, const SamplerFactory& sampler, const Judge& judge, const Trial& trial, std::uint64_t base_seed, int threads,
            std::vector<float>& image) {
    Row row = identity_of(s, sampler, judge, trial, base_seed, threads);
    std::unique_ptr<SampleSource> source =
        sampler.bind(sampling_plan(s.scene, s.plan, row.prefix_of > 0 ? row.prefix_of : row.spp, row.seed));
    if (trial.layout != 0) source = std::make_unique<PermutedSource>(std::move(source), s.plan.layout, *trial.order);
    RenderOptions options;
    options.threads = threads;
    const RenderResult result = render(s.scene, s.plan, *source, {s.what.crop, 0, row.spp}, options);
    image = result.film.image();
    const Judge::Verdict verdict = judge.judge(image, with_flip(trial));
    const Vec3d mean = result.film.mean();
    row.kernel = result.stats.kernel;
    row.all = verdict.all;
    row.masked = verdict.masked;
    row.mean_rgb[0] = mean.x;
    row.mean_rgb[1] = mean.y;
    row.mean_rgb[2] = mean.z;
    row.wall_seconds = result.stats.wall_seconds;
    row.cpu_seconds = result.stats.cpu_seconds;
    row.sampler_seconds = result.stats.sampler_seconds;
    row.paths = result.stats.paths;
    row.rays = result.stats.rays.closest + result.stats.rays.shadow;
    row.invalid_samples = result.stats.invalid_samples;
    row.fill = fill_of(*source);
    return row;
}

}  // namespace koksma
