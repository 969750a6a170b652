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

namespace {

constexpr std::uint64_t kAverage = 64;

/// A scene with the picture that it should show, and the variance of that picture.
struct Ground {
    std::string name;
    Scene scene;
    RenderPlan plan;
    PixelRect rect;
    Image truth, variance;
    [[nodiscard]] double light() const { return means({truth}).front(); }
    /// Standard error of light().
    [[nodiscard]] double light_error() const { return std::sqrt(means({variance}).front() / static_cast<double>(variance.size())); }
};

Ground crop_with_reference(const Lab& lab, const std::string& name) {
    const Experiment experiment = load_experiment("default");
    BenchScene s = std::move(open_scenes(experiment, {name}).front());
    const Reference reference = obtain_reference(experiment, s, lab.registry, lab.threads);
    return {name + ", a crop", std::move(s.scene), s.plan, s.what.crop, reference.mean, reference.variance};
}

/// The whole picture, small, against a mean of eight renders with 512 samples a pixel.
Ground whole_picture(const Lab& lab, const std::string& name) {
    Stage stage = open_scattered(name + ".xml", {{"res", "64"}});
    const std::vector<Image> renders = replicate(lab, stage, kSobol, 512, 8);
    Ground out{name + ", the whole picture", {}, make_plan(stage.scene, stage.integrator), crop_of(stage.scene.film),
               mean_image(renders),          {}};
    out.scene = std::move(stage.scene);
    for (std::size_t i = 0; i < out.truth.size(); ++i) {
        std::vector<double> values;
        for (const Image& image : renders) values.push_back(static_cast<double>(image[i]));
        out.variance.push_back(static_cast<float>(moments(values).variance / static_cast<double>(values.size())));
    }
    return out;
}

struct Mode {
    const char* name;
    bool adaptive;
    AdaptiveMode mode;
};
constexpr Mode kModes[]{{"uniform", false, {}}, {"two-stage", true, AdaptiveMode::two_stage}, {"one-stage", true, AdaptiveMode::one_stage}};

/// One render in one mode.
AdaptiveResult render_once(const Lab& lab, const Ground& g, const SamplerFactory& sampler, const Mode& mode, std::uint64_t seed) {
    if (mode.adaptive) {
        AdaptiveSettings settings;
        settings.mode = mode.mode;
        settings.average_spp = kAverage;
        settings.seed = seed;
        return render_adaptive(g.scene, g.plan, sampler, g.rect, settings, lab.threads);
    }
    RenderOptions options;
    options.threads = lab.threads;
    const auto source = sampler.bind(sampling_plan(g.scene, g.plan, kAverage, seed));
    return {render(g.scene, g.plan, *source, {g.rect, 0, kAverage}, options).film, {kAverage}, static_cast<double>(kAverage), 0};
}

Image map_of(const std::vector<std::uint64_t>& counts) {
    Image map;
    for (const std::uint64_t count : counts) map.insert(map.end(), 3, static_cast<float>(std::log2(static_cast<double>(count)) / 10));
    return map;
}

void compare(Sheet& sheet, const Ground& g) {
    const Lab& lab = sheet.lab();
    const int n = lab.replicates(24);
    sheet.table(fmt::format("{}: an average of {} samples a pixel", g.name, kAverage),
                {"sampler", "sampling", "samples traced", "counts", "RMSE", "MSE gain over uniform", "error of the mean brightness (%)"});
    for (const auto& [label, sampler] : {std::pair{"random", kRandom}, std::pair{"Sobol'", kSobol}}) {
        const auto factory = lab.registry.make(sampler);
        std::vector<double> uniform;
        for (const Mode& mode : kModes) {
            std::vector<double> mse, error;
            double spent = 0;
            std::string counts;
            for (int r = 0; r < n; ++r) {
                const AdaptiveResult result = render_once(
                    lab, g, *factory, mode,
                    test_seed(lab.seed, g.scene.description.hash, sampler + mode.name, kAverage, static_cast<std::uint64_t>(r)));
                const Image image = result.film.image();
                mse.push_back(compare_to_reference(image, g.truth, g.variance).mse);
                error.push_back(means({image}).front() / g.light() - 1);
                spent += result.spent_spp / n;
                if (r > 0) continue;
                const auto [least, most] = std::minmax_element(result.counts.begin(), result.counts.end());
                counts = mode.adaptive ? fmt::format("{} to {}{}", *least, *most, mode.mode == AdaptiveMode::one_stage ? ", and 16" : "")
                                       : fmt::format("{}", *most);
                if (mode.adaptive && mode.mode == AdaptiveMode::two_stage)
                    sheet.picture(fmt::format("{}, {}: samples of each pixel (black 1, white 1024, by powers of two)", g.name, label),
                                  map_of(result.counts), g.rect.width, g.rect.height, 1.0f);
                sheet.picture(fmt::format("{}, {}: {}", g.name, label, mode.name), image, g.rect.width, g.rect.height);
            }
            if (uniform.empty()) uniform = mse;
            sheet.row({label, mode.name, spent, counts, root_of(mse), gain_of(mse, uniform), times(mean_of(error), 100)});
            // What has no bias; the reference's own error is allowed for.
            if (!mode.adaptive || mode.mode == AdaptiveMode::two_stage)
                sheet.check(fmt::format("{}, {}, {}: relative error of the mean brightness", g.name, label, mode.name), error, 0.0, 0.0,
                            4 * g.light_error() / g.light());
        }
    }
}

}  // namespace

void adaptive(Sheet& sheet) {
    for (const char* name : {"penumbra", "cornell"}) compare(sheet, whole_picture(sheet.lab(), name));
    for (const char* name : {"bokeh", "caustic"}) compare(sheet, crop_with_reference(sheet.lab(), name));
    sheet.note(
        "Two stages spend 16 of the 64 samples on a pilot that is thrown away: four scrambles of four samples, whose spread is the noise "
        "of the sequence. One stage keeps them, and with them a bias. The counts are powers of two, the good counts of Sobol' points. "
        "Samples go to pixels in proportion to the pilot's noise, as is best for independent samples; a picture whose noise is even gains "
        "nothing, and loses the pilot.");
}

}  // namespace koksma::lecture
