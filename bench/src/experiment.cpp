#include "experiment.h"

#include "json_error.h"
#include "json_keys.h"

#include <koksma/sampling/error.h>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cstdlib>
#include <fstream>

namespace koksma {

namespace {

using Json = nlohmann::json;

std::filesystem::path locate(const std::string& name_or_file) {
    if (name_or_file.ends_with(".json")) {
        if (!std::filesystem::exists(name_or_file)) throw Error(fmt::format("there is no experiment file {}", name_or_file));
        return name_or_file;
    }
    const std::filesystem::path folder = data_directory() / "bench" / "experiments";
    std::filesystem::path file = folder / (name_or_file + ".json");
    if (std::filesystem::exists(file)) return file;
    std::vector<std::string> names;
    std::error_code ignored;
    for (const auto& entry : std::filesystem::directory_iterator(folder, ignored)) names.push_back(entry.path().stem().string());
    std::sort(names.begin(), names.end());
    throw Error(fmt::format("unknown experiment '{}'; known: {}; or give a .json file", name_or_file, fmt::join(names, ", ")));
}

Json parse(const std::filesystem::path& file) {
    std::ifstream in(file);
    if (!in) throw Error(fmt::format("cannot read {}", file.string()));
    try {
        return Json::parse(in);
    } catch (const Json::parse_error& e) {
        throw Error(fmt::format("{}: {}", file.string(), text_of(e)));
    }
}

ExperimentScene scene_of(const Json& json, const std::string& where, const std::filesystem::path& folder) {
    ExperimentScene scene;
    std::string file;
    std::vector<int> crop;
    Keys keys(json, where);
    keys.read("file", file, true);
    keys.read("crop", crop, true);
    if (const Json* predictions = keys.object("predictions")) {
        if (!predictions->is_array()) throw Error(where + ": \"predictions\": expected a list");
        for (std::size_t i = 0; i < predictions->size(); ++i)
            scene.predictions.push_back(prediction_of((*predictions)[i], fmt::format("{}: predictions[{}]", where, i)));
    }
    keys.done();
    if (crop.size() != 4 || crop[0] < 0 || crop[1] < 0 || crop[2] < 1 || crop[3] < 1) throw Error(where + ": \"crop\" must be [x, y, width, height]");
    scene.file = std::filesystem::path(file).is_absolute() ? std::filesystem::path(file) : (folder / file).lexically_normal();
    scene.name = scene.file.stem().string();
    scene.crop = {crop[0], crop[1], crop[2], crop[3]};
    return scene;
}

void check(const Experiment& e) {
    const std::string where = e.file.string();
    if (e.scenes.empty() || e.samplers.empty() || e.spp.empty()) throw Error(where + ": scenes, samplers and spp may not be empty");
    for (std::size_t i = 0; i < e.scenes.size(); ++i)
        for (std::size_t k = 0; k < i; ++k)
            if (e.scenes[i].name == e.scenes[k].name) throw Error(fmt::format("{}: two scenes are named {}; rows are told apart by the file's name", where, e.scenes[i].name));
    if (e.spp.size() != e.replicates.size()) throw Error(fmt::format("{}: {} values of spp but {} of replicates", where, e.spp.size(), e.replicates.size()));
    for (std::size_t i = 0; i < e.spp.size(); ++i) {
        if (e.spp[i] == 0 || e.replicates[i] < 1) throw Error(where + ": spp and replicates must be 1 or more");
        if (i > 0 && e.spp[i] <= e.spp[i - 1]) throw Error(where + ": spp must increase");
    }
    if (e.effects.empty() || e.effects.front() != "needed") throw Error(where + ": \"effects\": the first set must be \"needed\", with which the others are compared");
    constexpr int kMostLayouts = 1000;
    if (e.layouts < 1 || e.layouts > kMostLayouts)
        throw Error(fmt::format("{}: \"layouts\" is {}; expected 1 (the layout as it stands) to {}", where, e.layouts, kMostLayouts));
    if (e.layouts > 1 && (e.layouts < 3 || *std::min_element(e.replicates.begin(), e.replicates.end()) < 2))
        throw Error(where +
                    ": a spread over layouts needs 3 layouts or more (the first is the one that is compared with the others) and 2 "
                    "replicates of each");
    if (e.progressive < 0 || e.progressive == 1)
        throw Error(where + ": \"progressive\": expected 0 (no such curve) or 2 replicates or more");
    if (e.reference.samplers.size() != 2 || e.reference.samplers[0] == e.reference.samplers[1])
        throw Error(where + ": \"reference\" needs two different samplers, one for each half");
    if (e.reference.replicates < 2 || e.reference.spp == 0) throw Error(where + ": a reference needs two replicates or more, and samples");
    if (e.picture_size < 1 || e.picture_spp == 0) throw Error(where + ": picture_size and picture_spp must be 1 or more");
}

}  // namespace

std::filesystem::path data_directory() {
    if (const char* dir = std::getenv("KOKSMA_DATA_DIR")) return dir;
    std::error_code none;  // installed: bin/koksma and share/koksma
    const std::filesystem::path program = std::filesystem::read_symlink("/proc/self/exe", none);
    if (std::filesystem::path data = program.parent_path().parent_path() / "share" / "koksma"; !none && std::filesystem::is_directory(data / "bench", none)) return data;
    return KOKSMA_SOURCE_DIR;
}

Experiment load_experiment(const std::string& name_or_file) {
    Experiment e;
    e.file = locate(name_or_file);
    e.name = e.file.stem().string();
    const Json json = parse(e.file);
    Keys keys(json, e.file.string());
    keys.read("title", e.title, true);
    keys.read("samplers", e.samplers, true);
    keys.read("spp", e.spp, true);
    keys.read("replicates", e.replicates, true);
    keys.read("own_counts", e.own_counts, false);
    keys.read("progressive", e.progressive, false);
    keys.read("layouts", e.layouts, false);
    keys.read("effects", e.effects, false);
    keys.read("seed", e.seed, false);
    keys.read("relmse_targets", e.targets, false);
    keys.read("crop_spp", e.crop_spp, false);
    keys.read("picture_size", e.picture_size, false);
    keys.read("picture_spp", e.picture_spp, false);
    const Json* scenes = keys.object("scenes");
    if (scenes == nullptr || !scenes->is_array()) throw Error(fmt::format("{}: \"scenes\": expected a list of objects with the keys file and crop", e.file.string()));
    for (std::size_t i = 0; i < scenes->size(); ++i)
        for (const std::string& effects : e.effects) {
            ExperimentScene scene = scene_of((*scenes)[i], fmt::format("{}: scenes[{}]", e.file.string(), i), e.file.parent_path());
            scene.effects = effects;
            if (effects != e.effects.front()) scene.name += "+" + effects;
            e.scenes.push_back(scene);
        }
    if (const Json* reference = keys.object("reference")) {
        Keys r(*reference, e.file.string() + ": reference");
        r.read("samplers", e.reference.samplers, true);
        r.read("replicates", e.reference.replicates, false);
        r.read("spp", e.reference.spp, false);
        r.done();
    }
    keys.done();
    check(e);
    return e;
}

std::vector<std::uint64_t> own_counts(const Experiment& e, const SamplerInfo& info) {
    using Rule = GoodCounts::Rule;
    const std::uint64_t base = info.good_counts.rule == Rule::power ? info.good_counts.base : (info.good_counts.rule == Rule::square ? 4 : 0);
    std::vector<std::uint64_t> counts;
    for (std::uint64_t n = base; base > 1 && n <= e.spp.back(); n *= base)
        if (n >= e.spp.front()) counts.push_back(n);
    return counts;
}

std::vector<Count> counts_of(const Experiment& e, const SamplerInfo& info) {
    std::vector<Count> counts;
    for (std::size_t i = 0; i < e.spp.size(); ++i) counts.push_back({e.spp[i], e.replicates[i]});
    if (!e.own_counts) return counts;
    for (const std::uint64_t n : own_counts(e, info)) {
        const auto next = std::lower_bound(counts.begin(), counts.end(), n, [](const Count& c, std::uint64_t spp) { return c.spp < spp; });
        if (next != counts.end() && next->spp == n) continue;
        counts.insert(next, {n, std::prev(next)->replicates});
    }
    return counts;
}

Experiment quick(Experiment e) {
    e.title += " (quick)";
    while (e.spp.size() > 1 && e.spp.back() > 64) {
        e.spp.pop_back();
        e.replicates.pop_back();
    }
    for (int& r : e.replicates) r = std::min(r, std::max(4, r / 2));
    e.progressive = std::min(e.progressive, 4);
    e.picture_spp = std::min<std::uint64_t>(e.picture_spp, 16);
    return e;
}

}  // namespace koksma
