#pragma once
// Render this, and say mean and standard error over replicates.

#include "describe.h"

#include <koksma/integrators/render.h>
#include <koksma/measure/statistics.h>
#include <koksma/sampling/error.h>
#include <koksma/sampling/registry.h>

#include <koksma_catch.h>

#include <cmath>
#include <cstdlib>
#include <string>
#include <string_view>
#include <vector>

namespace koksma::testing {

/// The samplers that the test program was linked with.
inline const Registry& samplers() {
    static const Registry registry = [] {
        Registry r;
        register_samplers(r);
        return r;
    }();
    return registry;
}

inline constexpr const char* kSobol = "sobol:randomize=owen";

/// The smallest admissible variant of the kernel that KOKSMA_TEST_KERNEL names ("reference"); a null pointer without one: the library's
/// choice.
inline const Kernel* kernel_asked_for(EffectSet effects) {
    const char* const family = std::getenv("KOKSMA_TEST_KERNEL");
    if (family == nullptr) return nullptr;
    for (const Kernel& k : kernels())
        if (k.name.starts_with(std::string(family) + "/") && k.effects.contains(effects)) return &k;
    throw Error("KOKSMA_TEST_KERNEL is '" + std::string(family) + "', which has no kernel for this scene");
}

/// A scene with its plan, ready to be rendered any number of times.
struct Ready {
    Scene scene;
    RenderPlan plan;
    explicit Ready(const SceneDescription& d) : scene(compile(d)), plan(make_plan(scene, d.integrator)) {}

    [[nodiscard]] RenderResult render(std::string_view sampler, std::uint64_t spp, std::uint64_t seed, const RenderOptions& options = {}) const {
        return render(sampler, spp, seed, {crop_of(scene.film), 0, spp}, options);
    }
    [[nodiscard]] RenderResult render(std::string_view sampler, std::uint64_t spp, std::uint64_t seed, const WorkItem& work,
                                      const RenderOptions& options = {}) const {
        const auto source = samplers().make(sampler)->bind(sampling_plan(scene, plan, spp, seed));
        RenderOptions with_kernel = options;
        if (with_kernel.kernel == nullptr) with_kernel.kernel = kernel_asked_for(plan.effects);
        return koksma::render(scene, plan, *source, work, with_kernel);
    }
};

/// Mean radiance of the film, green channel, over replicates with independent seeds.
struct Measured {
    double mean = 0, standard_error = 0;
    int replicates = 0;
    std::uint64_t invalid = 0;
    double lowest = 0, highest = 0;  ///< among the replicates
    /// Half-width of an interval that holds the truth with probability 0.9999: t over replicates.
    [[nodiscard]] double noise() const { return student_t_factor(0.9999, replicates - 1) * standard_error; }
};

[[nodiscard]] inline Measured measured(const std::vector<double>& means, std::uint64_t invalid = 0) {
    const Moments m = moments(means);
    Measured out{m.mean, std::sqrt(m.variance / m.n), m.n, invalid, means[0], means[0]};
    for (const double x : means) {
        out.lowest = std::min(out.lowest, x);
        out.highest = std::max(out.highest, x);
    }
    return out;
}

[[nodiscard]] inline Measured measure(const Ready& ready, std::uint64_t spp = 256, int replicates = 8, std::string_view sampler = kSobol,
                                      std::uint64_t first_seed = 1) {
    std::vector<double> means;
    std::uint64_t invalid = 0;
    for (int r = 0; r < replicates; ++r) {
        const RenderResult result = ready.render(sampler, spp, first_seed + static_cast<std::uint64_t>(r));
        means.push_back(result.film.mean().y);
        invalid += result.stats.invalid_samples;
    }
    return measured(means, invalid);
}
[[nodiscard]] inline Measured measure(const SceneDescription& d, std::uint64_t spp = 256, int replicates = 8, std::string_view sampler = kSobol) {
    return measure(Ready(d), spp, replicates, sampler);
}

/// The check_mean() that came nearest to failing, for the record of a test. All relative to the expected value.
struct WorstCheck {
    double share = -1.0;  ///< error over what was allowed
    double error = 0, noise = 0, tolerance = 0;
};
[[nodiscard]] inline WorstCheck& worst_check() noexcept {
    static WorstCheck worst;
    return worst;
}

/// Checks that the mean is `expected` up to a relative tolerance, noise excluded, and that the noise is small enough to tell. Where 0 is
/// expected, that it is 0.
inline void check_mean(const Measured& m, double expected, double relative) {
    const double scale = expected != 0 ? std::fabs(expected) : 1, error = (m.mean - expected) / scale, allowed = relative * std::fabs(expected) + m.noise();
    INFO("mean " << m.mean << " expected " << expected << " relative error " << error << " tolerance " << relative << " standard error "
                 << m.standard_error << " invalid " << m.invalid);
    const double share = allowed > 0 ? std::fabs(m.mean - expected) / allowed : m.mean == expected ? 0 : 1e300;
    if (!(share <= worst_check().share)) worst_check() = {share, error, m.noise() / scale, relative};
    CHECK(m.invalid == 0);
    CHECK(std::fabs(m.mean - expected) <= relative * std::fabs(expected) + m.noise());
    CHECK(m.standard_error <= relative * std::fabs(expected));
}

/// As check_mean, for a value of which nothing but the noise is allowed.
inline void check_noise(const Measured& m, double expected, double largest_relative_noise) {
    INFO("mean " << m.mean << " expected " << expected << " standard error " << m.standard_error << " invalid " << m.invalid);
    CHECK(m.invalid == 0);
    CHECK(std::fabs(m.mean - expected) <= m.noise() + 1e-6 * std::fabs(expected));
    CHECK(m.standard_error <= largest_relative_noise * std::fabs(expected));
}

/// True if two films hold the same bytes.
[[nodiscard]] inline bool same_bytes(const Film& a, const Film& b) {
    const PixelRect r = a.rect();
    for (std::int32_t y = r.y; y < r.y + r.height; ++y)
        for (std::int32_t x = r.x; x < r.x + r.width; ++x)
            if (!(a.mean({x, y}) == b.mean({x, y})) || a.count({x, y}) != b.count({x, y})) return false;
    return true;
}

}  // namespace koksma::testing
