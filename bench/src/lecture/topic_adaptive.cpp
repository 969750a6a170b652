// Uniform against adaptive sampling at one budget, and what keeping the pilot does to the picture.

#include "topics.h"

#include "../bench_scene.h"
#include "../obtain_reference.h"

#include <koksma/integrators/lecture/adaptive.h>
#include <koksma/measure/metrics.h>
#include <koksma/measure/seeds.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace koksma::lecture {

void adaptive(Sheet& sheet) {
    const Lab& lab = sheet.lab();
    constexpr std::uint64_t kAverage = 64;
    const int n = lab.replicates(24);
    const Experiment experiment = load_experiment("default");
    for (const BenchScene& s : open_scenes(experiment, {"penumbra", "caustic"})) {
        const Reference reference = obtain_reference(experiment, s, lab.registry, lab.threads);
        double light = 0, light_variance = 0;
        for (std::size_t i = 0; i < reference.mean.size(); ++i) {
            light += static_cast<double>(reference.mean[i]) / static_cast<double>(reference.mean.size());
            light_variance += static_cast<double>(reference.variance[i]) / std::pow(static_cast<double>(reference.mean.size()), 2);
        }
        sheet.table(
            fmt::format("{}: an average of {} samples a pixel, against the reference", s.what.name, kAverage),
            {"sampler", "sampling", "samples traced", "counts", "RMSE", "MSE gain over uniform", "error of the mean brightness (%)"});
        for (const std::string& sampler : {kRandom, kSobol}) {
            const auto factory = lab.registry.make(sampler);
            const char* label = sampler == kRandom ? "random" : "Sobol'";
            std::vector<double> uniform;
            for (const char* mode : {"uniform", "two-stage", "one-stage"}) {
                std::vector<double> mse, bias;
                double spent = 0;
                std::string counts = "64";
                for (int r = 0; r < n; ++r) {
                    const std::uint64_t seed =
                        test_seed(lab.seed, s.key.scene_hash, sampler + mode, kAverage, static_cast<std::uint64_t>(r));
                    Image image;
                    if (std::string_view(mode) == "uniform") {
                        const auto source = factory->bind(sampling_plan(s.scene, s.plan, kAverage, seed));
                        RenderOptions options;
                        options.threads = lab.threads;
                        image = render(s.scene, s.plan, *source, {s.what.crop, 0, kAverage}, options).film.image();
                        spent += static_cast<double>(kAverage) / n;
                    } else {
                        AdaptiveSettings settings;
                        settings.mode = std::string_view(mode) == "two-stage" ? AdaptiveMode::two_stage : AdaptiveMode::one_stage;
                        settings.average_spp = kAverage;
                        settings.seed = seed;
                        const AdaptiveResult result = render_adaptive(s.scene, s.plan, *factory, s.what.crop, settings, lab.threads);
                        image = result.film.image();
                        spent += result.spent_spp / n;
                        if (r == 0) {
                            const auto [least, most] = std::minmax_element(result.counts.begin(), result.counts.end());
                            counts = fmt::format("{} to {}{}", *least, *most, settings.mode == AdaptiveMode::one_stage ? ", and 16" : "");
                            if (settings.mode == AdaptiveMode::two_stage) {
                                Image map;
                                for (const std::uint64_t count : result.counts)
                                    map.insert(map.end(), 3, static_cast<float>(std::log2(static_cast<double>(count)) / 10));
                                sheet.picture(fmt::format("{}, {}: samples of each pixel, in powers of two", s.what.name, label), map,
                                              s.what.crop.width, s.what.crop.height, 1.0f);
                            }
                        }
                    }
                    mse.push_back(compare_to_reference(image, reference.mean, reference.variance).mse);
                    bias.push_back(means({image}).front() / light - 1);
                    if (r == 0)
                        sheet.picture(fmt::format("{}, {}: {}", s.what.name, label, mode), image, s.what.crop.width, s.what.crop.height);
                }
                if (uniform.empty()) uniform = mse;
                sheet.row({label, mode, spent, counts, root_of(mse), gain_of(mse, uniform), times(mean_of(bias), 100)});
                // The reference's own error of the mean is small beside that of the replicates, and is allowed for.
                if (std::string_view(mode) != "one-stage")
                    sheet.check(fmt::format("{}, {}, {}: relative error of the mean brightness", s.what.name, label, mode), bias, 0.0, 0.0,
                                4 * std::sqrt(light_variance) / light);
            }
        }
    }
    sheet.note(
        "Two stages spend 16 of the 64 samples on a pilot that is thrown away: four scrambles of four samples, whose spread is the noise "
        "of the sequence. One stage keeps "
        "them. The counts are powers of two, the good counts of Sobol' points. Samples go to pixels in proportion to the pilot's noise, as "
        "independent samples want it; an error that "
        "falls faster than that of independent samples wants less contrast.");
}

}  // namespace koksma::lecture
