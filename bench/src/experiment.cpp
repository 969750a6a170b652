#include "experiment.h"

#include <koksma/sampling/error.h>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <set>

namespace koksma {

namespace {

using Json = nlohmann::json;

/// Reads the keys of one object and complains about those that nobody asked for.
class Keys {
public:
    Keys(const Json& json, std::string where) : json_(json), where_(std::move(where)) {
        if (!json.is_object()) throw Error(where_ + ": expected an object");
    }
    template <class T>
    void read(const char* key, T& value, bool required) {
        known_.insert(key);
        const auto it = json_.find(key);
        if (it == json_.end()) {
            if (required) throw Error(fmt::format("{}: the key \"{}\" is missing", where_, key));
            return;
        }
        try {
            value = it->template get<T>();
        } catch (const Json::exception&) {
            throw Error(fmt::format("{}: \"{}\" has the wrong type: {}", where_, key, it->dump()));
        }
    }
    [[nodiscard]] const Json* object(const char* key) {
        known_.insert(key);
        const auto it = json_.find(key);
        return it == json_.end() ? nullptr : &*it;
    }
    void done() const {
        for (const auto& item : json_.items())
            if (!known_.contains(item.key())) throw Error(fmt::format("{}: unknown key \"{}\"; known keys: {}", where_, item.key(), fmt::join(known_, ", ")));
    }

private:
    const Json& json_;
    std::string where_;
    std::set<std::string> known_;
};

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
        throw Error(fmt::format("{}: {}", file.string(), e.what()));
    }
}

ExperimentScene scene_of(const Json& json, const std::string& where, const std::filesystem::path& folder) {
    ExperimentScene scene;
    std::string file;
    std::vector<int> crop;
    Keys keys(json, where);
    keys.read("file", file, true);
    keys.read("crop", crop, true);
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
    if (e.spp.size() != e.replicates.size()) throw Error(fmt::format("{}: {} values of spp but {} of replicates", where, e.spp.size(), e.replicates.size()));
    for (std::size_t i = 0; i < e.spp.size(); ++i) {
        if (e.spp[i] == 0 || e.replicates[i] < 1) throw Error(where + ": spp and replicates must be 1 or more");
        if (i > 0 && e.spp[i] <= e.spp[i - 1]) throw Error(where + ": spp must increase");
    }
    if (e.reference.samplers.size() != 2 || e.reference.samplers[0] == e.reference.samplers[1])
        throw Error(where + ": \"reference\" needs two different samplers, one for each half");
    if (e.reference.replicates < 2 || e.reference.spp == 0) throw Error(where + ": a reference needs two replicates or more, and samples");
}

}  // namespace

std::filesystem::path data_directory() {
    if (const char* dir = std::getenv("KOKSMA_DATA_DIR")) return dir;
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
    keys.read("seed", e.seed, false);
    keys.read("relmse_targets", e.targets, false);
    keys.read("crop_spp", e.crop_spp, false);
    keys.read("picture_size", e.picture_size, false);
    keys.read("picture_spp", e.picture_spp, false);
    if (const Json* scenes = keys.object("scenes"); scenes != nullptr && scenes->is_array())
        for (std::size_t i = 0; i < scenes->size(); ++i)
            e.scenes.push_back(scene_of((*scenes)[i], fmt::format("{}: scenes[{}]", e.file.string(), i), e.file.parent_path()));
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

Experiment quick(Experiment e) {
    e.title += " (quick)";
    while (e.spp.size() > 1 && e.spp.back() > 64) {
        e.spp.pop_back();
        e.replicates.pop_back();
    }
    for (int& r : e.replicates) r = std::max(4, r / 2);
    e.picture_spp = std::min<std::uint64_t>(e.picture_spp, 16);
    return e;
}

}  // namespace koksma
