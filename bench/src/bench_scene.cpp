#include "bench_scene.h"

#include "reference_store.h"
#include "scene_setup.h"

#include <fmt/format.h>

#include <algorithm>

namespace koksma {

BenchScene open_scene(const ExperimentScene& what) {
    BenchScene out{what, compile(load_scene(what.file)), {}, {}};
    const FilmSettings& film = out.scene.film;
    if (what.crop.x > film.width - what.crop.width || what.crop.y > film.height - what.crop.height)
        throw Error(fmt::format("{}: the experiment's crop {}x{}+{}+{} is not inside the film of {}x{} pixels", what.file.string(), what.crop.width, what.crop.height,
                                what.crop.x, what.crop.y, film.width, film.height));
    const IntegratorSettings& settings = out.scene.description.integrator;
    out.plan = make_plan(out.scene, settings, effects_of(what.effects, needed_effects(out.scene, settings)));
    out.key = reference_key(out.scene, out.plan, what.file.stem().string(), what.crop);
    return out;
}

std::vector<BenchScene> open_scenes(const Experiment& experiment, const std::vector<std::string>& only) {
    std::vector<BenchScene> out;
    std::string known;
    for (const ExperimentScene& s : experiment.scenes) {
        known += (known.empty() ? "" : ", ") + s.name;
        if (only.empty() || std::find(only.begin(), only.end(), s.name) != only.end()) out.push_back(open_scene(s));
    }
    for (const std::string& name : only)
        if (std::none_of(out.begin(), out.end(), [&](const BenchScene& s) { return s.what.name == name; }))
            throw UsageError(fmt::format("experiment {} has no scene '{}'; its scenes: {}", experiment.name, name, known));
    return out;
}

}  // namespace koksma
