#pragma once
// Render this with an estimator, and say mean and standard error over replicates.

#include <scenes/render_scene.h>

#include <koksma/integrators/lecture/render_estimate.h>

#include <string_view>
#include <vector>

namespace koksma::testing {

/// A scene with the plan of an estimator.
struct Estimator {
    Scene scene;
    EstimatorSettings settings;
    RenderPlan plan;
    Estimator(const SceneDescription& d, const EstimatorSettings& s)
        : scene(compile(d)), settings(s), plan(make_plan(scene, d.integrator, s)) {}

    [[nodiscard]] EstimateResult render(std::string_view sampler, std::uint64_t spp, std::uint64_t seed, bool terms = false,
                                        int threads = 0) const {
        const auto source = samplers().make(sampler)->bind(sampling_plan(scene, plan, spp, seed));
        return render_estimate(scene, plan, *source, {crop_of(scene.film), 0, spp}, settings, terms, threads);
    }
};

[[nodiscard]] inline EstimatorSettings with(Technique light, std::string_view end = "throughput", std::uint32_t branching = 1) {
    EstimatorSettings s;
    s.light = light;
    s.branching = branching;
    set_end(s, end);
    return s;
}

[[nodiscard]] inline Measured measure(const Estimator& e, std::uint64_t spp = 256, int replicates = 8,
                                      std::string_view sampler = "random") {
    std::vector<double> means;
    std::uint64_t invalid = 0;
    for (int r = 0; r < replicates; ++r) {
        const EstimateResult result = e.render(sampler, spp, 1 + static_cast<std::uint64_t>(r));
        means.push_back(result.film.mean().y);
        invalid += result.ledger.invalid_samples;
    }
    return measured(means, invalid);
}

/// Variance of one camera sample, for independent numbers and an image whose pixels all have the mean `truth`: one value a replicate.
[[nodiscard]] inline Moments sample_variance(const Estimator& e, double truth, std::uint64_t spp, int replicates) {
    std::vector<double> values;
    for (int r = 0; r < replicates; ++r) {
        const std::vector<float> image = e.render("random", spp, 1 + static_cast<std::uint64_t>(r)).film.image();
        double sum = 0;
        for (std::size_t i = 1; i < image.size(); i += 3)
            sum += (static_cast<double>(image[i]) - truth) * (static_cast<double>(image[i]) - truth);
        values.push_back(sum / static_cast<double>(image.size() / 3) * static_cast<double>(spp));
    }
    return moments(values);
}

/// An empty furnace: every surface shines with radiance 1 and reflects `albedo`. Its radiance is 1 / (1 - albedo).
[[nodiscard]] inline SceneDescription empty_furnace(float albedo, int max_depth, int pixels = 16) {
    SceneDescription d = furnace(CubeShape{}, Matrix(1.0), albedo, 1.0f);
    d.film.width = d.film.height = pixels;
    d.integrator.max_depth = max_depth;
    d.integrator.rr_depth = 0;
    return d;
}

}  // namespace koksma::testing
