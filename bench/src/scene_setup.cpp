#include "scene_setup.h"

#include <koksma/measure/seeds.h>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

namespace koksma {

SceneParameters parameters_of(const std::vector<std::string>& defines) {
    SceneParameters parameters;
    for (const std::string& d : defines) {
        const auto equals = d.find('=');
        if (equals == std::string::npos || equals == 0) throw UsageError(fmt::format("-D {}: expected name=value", d));
        parameters[d.substr(0, equals)] = d.substr(equals + 1);
    }
    return parameters;
}

EffectSet effects_of(const std::string& names, EffectSet needed) {
    EffectSet effects;
    for (std::size_t at = 0; at <= names.size();) {
        const std::size_t end = std::min(names.find(',', at), names.size());
        const std::string name = names.substr(at, end - at);
        at = end + 1;
        if (name == "needed") {
            effects |= needed;
        } else if (name == "all") {
            effects |= largest_effects(needed);
        } else if (const EffectSet one = EffectSet::named(name); one.size() == 1) {
            effects |= one;
        } else {
            throw UsageError(fmt::format("unknown effect '{}'; effects: needed, all, {}", name, fmt::join(EffectSet::all().names(), ", ")));
        }
    }
    return effects;
}

std::unique_ptr<SamplerFactory> make_sampler(const Registry& registry, const std::string& spec) {
    try {
        return registry.make(spec);
    } catch (const Error& e) {
        throw UsageError(e.what());
    }
}

SceneSetup set_up(const SceneArguments& a, const Registry& registry) {
    // What is wrong with the arguments is said before a large scene is read.
    if (a.spp && *a.spp == 0) throw UsageError("--spp is 0; expected 1 or more");
    if (a.seed && *a.seed >= kReferenceSeedBit) throw UsageError("--seed must be below 2^63 (the seeds above belong to references)");
    if (a.max_depth && *a.max_depth < -1) throw UsageError(fmt::format("--max-depth is {}; expected -1 (no limit), 0 or more", *a.max_depth));
    if (a.rr_depth && *a.rr_depth < 0) throw UsageError(fmt::format("--rr-depth is {}; expected 0 or more", *a.rr_depth));
    if (a.sampler) static_cast<void>(make_sampler(registry, *a.sampler));

    SceneDescription description = load_scene(a.scene, parameters_of(a.defines));
    if (a.max_depth) description.integrator.max_depth = *a.max_depth;
    if (a.rr_depth) description.integrator.rr_depth = *a.rr_depth;
    if (!a.technique.empty())
        description.integrator.technique = a.technique == "light"  ? Technique::light
                                           : a.technique == "bsdf" ? Technique::bsdf
                                                                   : Technique::mis;
    if (!a.crop.empty()) {
        FilmSettings& film = description.film;
        if (a.crop[0] < 0 || a.crop[1] < 0 || a.crop[2] < 1 || a.crop[3] < 1 || a.crop[0] > film.width - a.crop[2] || a.crop[1] > film.height - a.crop[3])
            throw UsageError(fmt::format("--crop {},{},{},{} is not inside the film of {}x{} pixels", a.crop[0], a.crop[1], a.crop[2], a.crop[3], film.width, film.height));
        film.crop_x = a.crop[0];
        film.crop_y = a.crop[1];
        film.crop_width = a.crop[2];
        film.crop_height = a.crop[3];
    }
    SceneSetup setup{compile(description), {}, {}, 1, 0};
    const EffectSet needed = needed_effects(setup.scene, description.integrator), effects = effects_of(a.effects, needed);
    try {
        setup.plan = make_plan(setup.scene, description.integrator, effects);
    } catch (const Error& e) {
        throw UsageError(fmt::format("--effects {}: {}", a.effects, e.what()));
    }
    const std::string from_scene = description.sampler.empty() ? kDefaultSampler : description.sampler;
    setup.sampler = make_sampler(registry, a.sampler ? *a.sampler : from_scene);
    setup.spp = a.spp.value_or(description.spp);
    setup.seed = a.seed.value_or(description.seed);
    if (setup.spp == 0) throw Error(fmt::format("{}: sample_count is 0; expected 1 or more", description.file));
    return setup;
}

std::unique_ptr<SampleSource> SceneSetup::bind() const { return sampler->bind(sampling_plan(scene, plan, spp, seed)); }

}  // namespace koksma
