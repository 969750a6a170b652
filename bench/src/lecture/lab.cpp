#include "lab.h"

#include "../experiment.h"

#include <koksma/integrators/render.h>
#include <koksma/measure/seeds.h>
#include <koksma/sampling/mixed_source.h>

#include <fmt/format.h>

#include <algorithm>

namespace koksma::lecture {

namespace {

std::uint64_t seed_of(const Lab& lab, const Stage& stage, const std::string& what, std::uint64_t spp, int replicate) {
    return test_seed(lab.seed, stage.scene.description.hash, what, spp, static_cast<std::uint64_t>(replicate));
}

double squared_difference(const Image& a, const Image& b) {
    double sum = 0;
    for (std::size_t i = 0; i < a.size(); ++i)
        sum += (static_cast<double>(a[i]) - static_cast<double>(b[i])) * (static_cast<double>(a[i]) - static_cast<double>(b[i]));
    return sum / static_cast<double>(a.size());
}

}  // namespace

Stage open(const std::string& file, const SceneParameters& defines) {
    const std::filesystem::path path = data_directory() / "scenes" / file;
    Stage stage{path.stem().string(), compile(load_scene(path, defines)), {}};
    stage.integrator = stage.scene.description.integrator;
    return stage;
}

Stage open_scattered(const std::string& file, const SceneParameters& defines) {
    Stage stage = open(file, defines);
    stage.integrator.hide_emitters = true;
    return stage;
}

EstimatorSettings estimator(Technique light, std::string_view end, std::uint32_t branching) {
    EstimatorSettings s;
    s.light = light;
    s.branching = branching;
    set_end(s, end);
    return s;
}

Replicates replicate(const Lab& lab, const Stage& stage, const EstimatorSettings& s, const std::string& sampler, std::uint64_t spp,
                     int count, bool terms) {
    const RenderPlan plan = make_plan(stage.scene, stage.integrator, s);
    const auto factory = lab.registry.make(sampler);
    const std::string what = fmt::format("{} {} {} {} {} {} rr{}", sampler, name(s.light), name(s.direction), text_of_end(s),
                                         name(s.number), s.branching, plan.integrator.rr_depth);
    Replicates out;
    out.spp = spp;
    out.terms.resize(terms ? NeumannSeries::kTerms : 0);
    for (int r = 0; r < count; ++r) {
        const auto source = factory->bind(sampling_plan(stage.scene, plan, spp, seed_of(lab, stage, what, spp, r)));
        const EstimateResult result =
            render_estimate(stage.scene, plan, *source, {crop_of(stage.scene.film), 0, spp}, s, terms, lab.threads);
        out.images.push_back(result.film.image());
        for (std::size_t k = 0; k < result.terms.size(); ++k) out.terms[k].push_back(result.terms[k].image());
        out.ledger.merge(result.ledger);
    }
    return out;
}

std::vector<Image> replicate(const Lab& lab, const Stage& stage, const std::string& sampler, std::uint64_t spp, int count, bool centre) {
    const RenderPlan plan = make_plan(stage.scene, stage.integrator);
    const auto factory = lab.registry.make(sampler);
    SlotSet film(plan.layout.slots().size());
    film.front() = true;
    std::vector<Image> out;
    RenderOptions options;
    options.threads = lab.threads;
    for (int r = 0; r < count; ++r) {
        const std::uint64_t seed = seed_of(lab, stage, sampler + (centre ? " centre" : " box"), spp, r);
        std::unique_ptr<SampleSource> source = factory->bind(sampling_plan(stage.scene, plan, spp, seed));
        if (centre)
            source = std::make_unique<MixedSource>(std::move(source), std::make_unique<ConstantSource>(0.5f, seed), plan.layout, film);
        out.push_back(render(stage.scene, plan, *source, {crop_of(stage.scene.film), 0, spp}, options).film.image());
    }
    return out;
}

Image mean_image(const std::vector<Image>& images) {
    Image out(images.front().size());
    for (std::size_t i = 0; i < out.size(); ++i) {
        double sum = 0;
        for (const Image& image : images) sum += static_cast<double>(image[i]);
        out[i] = static_cast<float>(sum / static_cast<double>(images.size()));
    }
    return out;
}

Image sum_of(const std::vector<Image>& images) {
    Image out(images.front().size());
    for (const Image& image : images)
        for (std::size_t i = 0; i < out.size(); ++i) out[i] += image[i];
    return out;
}

std::vector<double> squared_errors(const std::vector<Image>& images) {
    const Image mean = mean_image(images);
    const auto n = static_cast<double>(images.size());
    std::vector<double> out = squared_errors(images, mean);
    for (double& v : out) v *= n / (n - 1.0);
    return out;
}

std::vector<double> squared_errors(const std::vector<Image>& images, const Image& truth) {
    std::vector<double> out;
    for (const Image& image : images) out.push_back(squared_difference(image, truth));
    return out;
}

std::vector<double> means(const std::vector<Image>& images) {
    std::vector<double> out;
    for (const Image& image : images) {
        double sum = 0;
        for (const float v : image) sum += static_cast<double>(v);
        out.push_back(sum / static_cast<double>(image.size()));
    }
    return out;
}

}  // namespace koksma::lecture
