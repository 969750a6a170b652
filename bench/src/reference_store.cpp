#include "reference_store.h"

#include <koksma/measure/agreement.h>
#include <koksma/measure/seeds.h>
#include <koksma/measure/statistics.h>

#include <fmt/format.h>

#include <cstdlib>

namespace koksma {

ReferenceKey reference_key(const Scene& scene, const RenderPlan& plan, const std::string& name, PixelRect rect) {
    return {name, scene.description.hash, rect, plan.integrator, kEstimatorVersion};
}

std::filesystem::path reference_cache() {
    if (const char* dir = std::getenv("KOKSMA_REFERENCE_DIR")) return dir;
    if (const char* dir = std::getenv("XDG_CACHE_HOME")) return std::filesystem::path(dir) / "koksma" / "references";
    if (const char* home = std::getenv("HOME")) return std::filesystem::path(home) / ".cache" / "koksma" / "references";
    return "koksma-references";
}

std::optional<std::filesystem::path> find_reference(const ReferenceKey& key) {
    for (const std::filesystem::path& folder : {reference_cache(), data_directory() / "bench" / "references"})
        if (std::filesystem::path file = folder / reference_file_name(key); std::filesystem::exists(file)) return file;
    return std::nullopt;
}

namespace {

/// One sampler for each half. @throws Error if they could not tell the reference's own error
std::vector<std::unique_ptr<SamplerFactory>> reference_samplers(const ReferenceKey& key, const Experiment& experiment, const Registry& registry) {
    std::vector<std::unique_ptr<SamplerFactory>> samplers;
    for (const std::string& spec : experiment.reference.samplers) {
        try {
            samplers.push_back(registry.make(spec));
        } catch (const Error& e) {
            throw Error(fmt::format("the reference of {} cannot be made: {}", key.scene, e.what()));
        }
        if (!samplers.back()->randomized()) throw Error(fmt::format("the reference of {} cannot be made: {} has no randomisation, so no replicates", key.scene, samplers.back()->name()));
    }
    if (samplers[0]->name() == samplers[1]->name()) throw Error(fmt::format("the reference of {} cannot be made: both halves would be {}", key.scene, samplers[0]->name()));
    return samplers;
}

}  // namespace

Reference make_reference(const Scene& scene, const RenderPlan& plan, const ReferenceKey& key, const Experiment& experiment, std::uint64_t spp,
                         const Registry& registry, int threads, const std::function<void(double)>& progress) {
    Reference reference{key, {}, {}, {}};
    const int n = experiment.reference.replicates;
    const auto samplers = reference_samplers(key, experiment, registry);
    for (int half = 0; half < 2; ++half) {
        const auto& sampler = samplers[static_cast<std::size_t>(half)];
        HalfAccumulator sum;
        for (int r = 0; r < n; ++r) {
            const std::uint64_t seed = reference_seed(key.scene_hash, sampler->name(), static_cast<std::uint64_t>(r));
            const auto source = sampler->bind(sampling_plan(scene, plan, spp, seed));
            RenderOptions options;
            options.threads = threads;
            options.progress = [&](double f) { progress((half * n + r + f) / (2.0 * n)); };
            const RenderResult result = render(scene, plan, *source, {key.rect, 0, spp}, options);
            if (result.stats.invalid_samples > 0)
                throw Error(fmt::format("the reference of {} has {} invalid samples; koksma render --stats locates them", key.scene, result.stats.invalid_samples));
            sum.add(result.film.image());
        }
        reference.halves[half] = sum.finish(sampler->name(), spp);
    }
    reference.combine();
    require_agreement(reference);
    return reference;
}

double require_agreement(const Reference& reference) {
    const ReferenceHalf &a = reference.halves[0], &b = reference.halves[1];
    const Agreement result = agreement(a.mean, a.variance, b.mean, b.variance, reference.key.rect.width, reference.key.rect.height);
    // The block variances come from few replicates: t, not normal; 1e-6 over all blocks is a clear defect, not chance.
    const double dof = a.replicates + b.replicates - 2.0;
    const double limit = student_t_factor(1.0 - 1e-6 / (3.0 * std::max(1, result.blocks)), dof);
    if (result.max_block_z > limit)
        throw Error(fmt::format("the two halves of the reference of {} ({} and {}) disagree: z = {:.1f} in a block of 8x8 pixels (limit {:.1f})", reference.key.scene,
                                a.sampler, b.sampler, result.max_block_z, limit));
    return result.max_block_z;
}

}  // namespace koksma
