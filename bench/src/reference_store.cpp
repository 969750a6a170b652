#include "reference_store.h"

#include <koksma/film/atomic_file.h>
#include <koksma/measure/agreement.h>
#include <koksma/measure/metrics.h>
#include <koksma/measure/seeds.h>
#include <koksma/measure/statistics.h>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <fstream>

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

/// Reads what an interrupted run left, if it is of the same question; else the sums stay empty.
void read_steps(const std::filesystem::path& file, const std::string& question, int most, std::array<HalfAccumulator, 2>& sums) {
    std::ifstream in(file, std::ios::binary);
    std::string line;
    if (!in || !std::getline(in, line) || line + "\n" != question) return;
    try {
        std::array<HalfAccumulator, 2> read = {HalfAccumulator::read(in), HalfAccumulator::read(in)};
        if (read[0].replicates() <= most && read[1].replicates() <= most) sums = std::move(read);
    } catch (const Error&) {
        // as good as not there
    }
}

void write_steps(const std::filesystem::path& file, const std::string& question, const std::array<HalfAccumulator, 2>& sums) {
    write_atomically(file, [&](const std::filesystem::path& path) {
        std::ofstream out(path, std::ios::binary);
        out << question;
        for (const HalfAccumulator& sum : sums) sum.write(out);
        out.flush();
        if (!out) throw Error("the disk is full or the folder is not writable");
    });
}

/// The block variances come from few replicates: t, not normal; 1e-6 over all blocks is a clear defect, not chance.
double block_z_limit(const Agreement& result, double dof) { return student_t_factor(1.0 - 1e-6 / (3.0 * std::max(1, result.blocks)), dof); }

}  // namespace

Reference make_reference(const Scene& scene, const RenderPlan& plan, const ReferenceKey& key, const Experiment& experiment, std::uint64_t spp,
                         const Registry& registry, int threads, const std::function<void(double)>& progress, const std::filesystem::path& steps) {
    Reference reference{key, {}, {}, {}};
    const int n = experiment.reference.replicates;
    const auto samplers = reference_samplers(key, experiment, registry);
    std::array<HalfAccumulator, 2> sums;
    const std::string question = fmt::format("{} {} v{} {} v{} spp {}\n", key.digest(), samplers[0]->name(), samplers[0]->info().version, samplers[1]->name(),
                                             samplers[1]->info().version, spp);
    if (!steps.empty()) read_steps(steps, question, n, sums);
    for (std::size_t half = 0; half < 2; ++half) {
        const auto& sampler = samplers[half];
        HalfAccumulator& sum = sums[half];
        for (int r = sum.replicates(); r < n; ++r) {
            const std::uint64_t seed = reference_seed(key.scene_hash, sampler->name(), static_cast<std::uint64_t>(r));
            const auto source = sampler->bind(sampling_plan(scene, plan, spp, seed));
            RenderOptions options;
            options.threads = threads;
            options.progress = [&](double f) { progress((static_cast<double>(half) * n + r + f) / (2.0 * n)); };
            const RenderResult result = render(scene, plan, *source, {key.rect, 0, spp}, options);
            if (result.stats.invalid_samples > 0)
                throw Error(fmt::format("the reference of {} has {} invalid samples; koksma render --stats locates them", key.scene, result.stats.invalid_samples));
            sum.add(result.film.image());
            if (!steps.empty()) write_steps(steps, question, sums);
        }
        reference.halves[half] = sum.finish(sampler->name(), spp);
    }
    reference.combine();
    std::error_code none;
    if (!steps.empty()) std::filesystem::remove(steps, none);  // also where the halves disagree: going on would not help
    require_agreement(reference);
    return reference;
}

ThirdOpinion third_opinion(const Scene& scene, const Reference& reference, std::uint64_t spp, int replicates, const Registry& registry, int threads,
                           const std::function<void(double)>& progress) {
    const ReferenceKey& key = reference.key;
    IntegratorSettings other = key.integrator;
    other.rr_depth = other.rr_depth > 1 ? 1 : other.rr_depth + 4;
    ThirdOpinion third;
    third.estimator = fmt::format("independent random numbers, roulette from depth {} instead of {}", other.rr_depth, key.integrator.rr_depth);
    const RenderPlan plan = make_plan(scene, other);
    const auto sampler = registry.make("random");
    HalfAccumulator sum;
    for (int r = 0; r < replicates; ++r) {
        const auto source = sampler->bind(sampling_plan(scene, plan, spp, reference_seed(key.scene_hash, "third opinion", static_cast<std::uint64_t>(r))));
        RenderOptions options;
        options.threads = threads;
        options.progress = [&](double f) { progress((r + f) / replicates); };
        sum.add(render(scene, plan, *source, {key.rect, 0, spp}, options).film.image());
    }
    const ReferenceHalf half = sum.finish(sampler->name(), spp);
    const Agreement result = agreement(half.mean, half.variance, reference.mean, reference.variance, key.rect.width, key.rect.height);
    third.max_block_z = result.max_block_z;
    third.limit = block_z_limit(result, replicates - 1.0);
    if (third.max_block_z > third.limit)
        throw Error(fmt::format("the reference of {} disagrees with another estimator ({}): z = {:.1f} in a block of 8x8 pixels (limit {:.1f})", key.scene, third.estimator,
                                third.max_block_z, third.limit));

    // A bias as large as the limit's z in a block's mean luminance would have been seen. Pixels are independent, so variances add.
    double image_sum = 0, image_variance = 0;
    std::vector<double> errors;
    for (int y0 = 0; y0 < key.rect.height; y0 += 8)
        for (int x0 = 0; x0 < key.rect.width; x0 += 8) {
            double variance = 0, pixels = 0;
            for (int y = y0; y < std::min(y0 + 8, key.rect.height); ++y)
                for (int x = x0; x < std::min(x0 + 8, key.rect.width); ++x, ++pixels)
                    for (std::size_t c = 0; c < 3; ++c) {
                        const std::size_t i = 3 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(key.rect.width) + static_cast<std::size_t>(x)) + c;
                        variance += kLuminance[c] * kLuminance[c] * (static_cast<double>(half.variance[i]) + static_cast<double>(reference.variance[i]));
                        image_sum += kLuminance[c] * static_cast<double>(reference.mean[i]);
                    }
            errors.push_back(std::sqrt(variance) / pixels);
            image_variance += variance;
        }
    std::nth_element(errors.begin(), errors.begin() + static_cast<std::ptrdiff_t>(errors.size() / 2), errors.end());
    const auto area = static_cast<double>(key.rect.area());
    third.block_bias = third.limit * errors[errors.size() / 2] / (image_sum / area);
    third.image_bias = student_t_factor(0.95, replicates - 1.0) * std::sqrt(image_variance) / image_sum;
    return third;
}

double require_agreement(const Reference& reference) {
    const ReferenceHalf &a = reference.halves[0], &b = reference.halves[1];
    const Agreement result = agreement(a.mean, a.variance, b.mean, b.variance, reference.key.rect.width, reference.key.rect.height);
    const double limit = block_z_limit(result, a.replicates + b.replicates - 2.0);
    if (result.max_block_z > limit)
        throw Error(fmt::format("the two halves of the reference of {} ({} and {}) disagree: z = {:.1f} in a block of 8x8 pixels (limit {:.1f})", reference.key.scene,
                                a.sampler, b.sampler, result.max_block_z, limit));
    return result.max_block_z;
}

}  // namespace koksma
