#include "commands.h"
#include "report.h"
#include "row_store.h"
#include "summary.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <map>
#include <set>
#include <tuple>

namespace koksma {

namespace {

using Json = nlohmann::ordered_json;

struct Part {
    std::filesystem::path folder;
    Json header;
    std::vector<Row> rows;
};

/// What the headers of all parts have in common. `why` names the first key that differs.
bool same_run(const Json& a, const Json& b, std::string& why) {
    for (const char* key : {"samplers", "relmse_targets", "crop_spp", "layouts", "any_count", "progressive", "trials"})
        if (a.value(key, Json()) != b.value(key, Json())) return why = key, false;
    for (const char* key : {"name", "title", "version"})
        if (a.at("experiment").at(key) != b.at("experiment").at(key)) return why = key, false;
    if (a.at("shard")[1] != b.at("shard")[1]) return why = "number of shards", false;
    if (a.at("scenes").size() != b.at("scenes").size()) return why = "scenes", false;
    for (std::size_t i = 0; i < a.at("scenes").size(); ++i)
        for (const char* key : {"name", "crop", "film", "max_depth", "rr_depth", "reference"})
            if (a.at("scenes")[i].at(key) != b.at("scenes")[i].at(key)) return why = fmt::format("scenes[{}].{}", i, key), false;
    return true;
}

void copy_files(const std::filesystem::path& from, const std::filesystem::path& to) {
    for (const char* name : {"pictures", "images"}) {
        std::error_code error;
        std::filesystem::create_directories(to / name, error);
        if (!error && std::filesystem::exists(from / name))
            std::filesystem::copy(from / name, to / name, std::filesystem::copy_options::overwrite_existing | std::filesystem::copy_options::recursive, error);
        if (error) throw Error(fmt::format("cannot copy {} to {}: {}", (from / name).string(), (to / name).string(), error.message()));
    }
}

}  // namespace

int run_merge(const MergeCommand& command) {
    std::vector<Part> parts;
    std::set<int> seen;
    for (const std::filesystem::path& folder : command.parts) {
        std::error_code none;
        if (std::filesystem::equivalent(folder, command.out, none)) throw UsageError(fmt::format("--out {} is one of the parts", command.out.string()));
        Part& part = parts.emplace_back();
        part.folder = folder;
        read_results(folder / "results.jsonl", part.header, part.rows);
        if (!part.header.contains("shard") || part.header.at("shard")[1] == 1) throw Error(fmt::format("{} is not a part: it was not made with --shard", folder.string()));
        std::string why;
        if (!same_run(parts.front().header, part.header, why))
            throw Error(fmt::format("{} and {} are not parts of one run: they differ in {}", parts.front().folder.string(), folder.string(), why));
        if (!seen.insert(part.header.at("shard")[0].get<int>()).second) throw Error(fmt::format("part {} is given twice", part.header.at("shard")[0].get<int>()));
    }
    Json header = parts.front().header;
    const int of = header.at("shard")[1];
    std::string missing;
    for (int k = 1; k <= of; ++k)
        if (!seen.contains(k)) missing += fmt::format("{}{}/{}", missing.empty() ? "" : ", ", k, of);
    if (!missing.empty()) throw Error("parts are missing: " + missing);

    std::map<std::string, std::size_t> scene_order, sampler_order;
    for (const Json& s : header.at("scenes")) scene_order.emplace(s.at("name"), scene_order.size());
    for (const Json& s : header.at("samplers")) sampler_order.emplace(s.at("sampler"), sampler_order.size());
    std::vector<Row> rows;
    std::set<std::string> keys, machines;
    for (const Part& part : parts)
        for (const Row& row : part.rows) {
            if (!keys.insert(key_of(row)).second) throw Error(fmt::format("{} has a row that another part has too: {}", part.folder.string(), key_of(row)));
            machines.insert(row.machine);
            rows.push_back(row);
        }
    if (rows.size() != header.at("trials").get<std::size_t>())
        throw Error(fmt::format("the parts have {} rows, the run {}", rows.size(), header.at("trials").get<std::size_t>()));
    const auto place = [&](const Row& r) {
        return std::tuple(scene_order.at(r.scene), r.prefix_of, r.replicate, r.spp, sampler_order.at(r.sampler), r.layout);
    };
    std::sort(rows.begin(), rows.end(), [&](const Row& a, const Row& b) { return place(a) < place(b); });

    for (const Part& part : parts) {
        copy_files(part.folder, command.out);
        for (std::size_t i = 0; i < header.at("scenes").size(); ++i) {
            const Json& scene = part.header.at("scenes")[i];
            if (!scene.at("picture").is_null()) header["scenes"][i]["picture"] = scene.at("picture");
            for (const auto& crop : scene.at("crops").items()) header["scenes"][i]["crops"][crop.key()] = crop.value();
        }
    }
    header["shard"] = {1, 1};
    if (machines.size() > 1) header["experiment"]["note"] = fmt::format("rendered on {} kinds of machines: seconds do not compare", machines.size());
    std::vector<Json> lines(rows.begin(), rows.end());
    write_results(command.out, header, lines);
    return finish_results(command.out, command.no_report);
}

}  // namespace koksma
