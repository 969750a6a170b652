#include "commands.h"
#include "estimator_json.h"
#include "machine.h"
#include "page.h"
#include "scene_setup.h"

#include <koksma/film/atomic_file.h>
#include <koksma/film/exr.h>
#include <koksma/integrators/lecture/render_estimate.h>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace koksma {

namespace {

EstimatorSettings settings_of(const EstimateCommand& c) {
    try {
        EstimatorSettings s;
        s.light = technique_of(c.light);
        s.direction = direction_strategy_of(c.directions);
        s.number = roulette_number_of(c.number);
        s.branching = c.branching;
        set_end(s, c.end);
        return s;
    } catch (const Error& e) {
        throw UsageError(e.what());
    }
}

/// Layers Le, Ldirect, Lindirect, and scattered0 ... for the terms one by one.
void add_layers(ExrImage& exr, const EstimateResult& result) {
    const auto add = [&](const std::string& layer, std::size_t first, std::size_t last) {
        std::vector<float>* planes[3] = {&exr.channels[layer + ".R"], &exr.channels[layer + ".G"], &exr.channels[layer + ".B"]};
        for (std::vector<float>* plane : planes) plane->resize(static_cast<std::size_t>(exr.width) * static_cast<std::size_t>(exr.height));
        for (std::size_t k = first; k <= last; ++k) {
            const std::vector<float> image = result.terms[k].image();
            for (std::size_t i = 0; i < image.size(); ++i) (*planes[i % 3])[i / 3] += image[i];
        }
    };
    const std::size_t last = result.terms.size() - 1;
    add("Le", 0, 0);
    add("Ldirect", 1, 1);
    add("Lindirect", 2, last);
    for (std::size_t k = 0; k <= last; ++k) add(fmt::format("scattered{}", k), k, k);
}

void tell(const EstimateResult& r) {
    const nlohmann::ordered_json l = json_of(r.ledger);
    const Vec3d mean = r.film.mean();
    fmt::print("mean      {:.6g} {:.6g} {:.6g}\n", mean.x, mean.y, mean.z);
    fmt::print("rays      {:.3f} a sample ({} closest, {} shadow)\n", l["rays_per_sample"].get<double>(), r.ledger.rays.closest,
               r.ledger.rays.shadow);
    fmt::print("truncated {} rays, {:.6g} of a sample's weight: times the radiance beyond, what the picture lacks\n",
               r.ledger.truncated.rays, l["truncated"]["weight"].get<double>());
    fmt::print("roulette  {} games, {} lost; {:.6g}: times the square of the radiance beyond, the variance that it adds to a sample\n",
               r.ledger.roulette.played, r.ledger.roulette.lost, l["roulette"]["excess"].get<double>());
    fmt::print("invalid   {} samples (they count as zero)\n", r.ledger.invalid_samples);
}

}  // namespace

int run_estimate(const EstimateCommand& command, const Registry& registry) {
    if (command.output.extension() != ".exr")
        throw UsageError(fmt::format("--output '{}': images are OpenEXR; give a name that ends in .exr", command.output.string()));
    const EstimatorSettings settings = settings_of(command);
    require_writable(command.output);
    if (!command.stats.empty()) require_writable(command.stats);
    SceneSetup setup = set_up(command.scene, registry);
    setup.plan = make_plan(setup.scene, setup.plan.integrator, settings);
    if (settings.branching > 1 && setup.sampler->info().kind == SamplerKind::set)
        throw UsageError(fmt::format("--branching {} needs a sequence; the samples of '{}' depend on how many there are",
                                     settings.branching, setup.sampler->name()));
    const std::unique_ptr<SampleSource> source = setup.bind();
    const EstimateResult result =
        render_estimate(setup.scene, setup.plan, *source, {setup.rect(), 0, setup.spp}, settings, true, command.threads);

    ExrImage exr;
    exr.width = setup.rect().width;
    exr.height = setup.rect().height;
    exr.data_x = setup.rect().x;
    exr.data_y = setup.rect().y;
    exr.display_width = setup.scene.film.width;
    exr.display_height = setup.scene.film.height;
    exr.set_rgb(result.film.image());
    add_layers(exr, result);
    exr.attributes = {{"koksma:version", version()},
                      {"koksma:commit", commit()},
                      {"koksma:scene", setup.scene.description.file},
                      {"koksma:sampler", setup.sampler->name()},
                      {"koksma:spp", std::to_string(setup.spp)},
                      {"koksma:seed", std::to_string(setup.seed)},
                      {"koksma:estimator", json_of(settings).dump()}};
    write_exr(command.output, exr);
    if (!command.stats.empty()) {
        nlohmann::ordered_json all = {{"scene", setup.scene.description.file},
                                      {"sampler", setup.sampler->name()},
                                      {"spp", setup.spp},
                                      {"seed", setup.seed},
                                      {"max_depth", setup.plan.integrator.max_depth},
                                      {"estimator", json_of(settings)},
                                      {"ledger", json_of(result.ledger)},
                                      {"cpu_seconds", result.cpu_seconds},
                                      {"wall_seconds", result.wall_seconds}};
        write_json(command.stats, all);
    }
    if (!command.quiet) tell(result);
    return 0;
}

}  // namespace koksma
