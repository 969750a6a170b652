#include "commands.h"
#include "sampler_json.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <limits>

namespace koksma {

namespace {

const char* text(SamplerKind k) { return k == SamplerKind::sequence ? "sequence" : "set"; }
const char* text(SamplerScope s) { return s == SamplerScope::pixel ? "pixel" : (s == SamplerScope::tile ? "tile" : "image"); }

template <class T>
std::string limit(T value) {
    return value == std::numeric_limits<T>::max() ? "no limit" : std::to_string(value);
}

}  // namespace

nlohmann::ordered_json json_of(const SamplerInfo& info) {
    nlohmann::ordered_json options = nlohmann::ordered_json::array();
    for (const OptionInfo& o : info.options) options.push_back({{"name", o.name}, {"default", o.default_value}, {"values", o.values}, {"help", o.help}});
    nlohmann::ordered_json j = {{"name", info.name},      {"title", info.title},     {"paper", info.paper},       {"version", info.version},
                                {"kind", text(info.kind)}, {"scope", text(info.scope)}, {"joint_group", info.joint == 0 ? nlohmann::ordered_json("all") : nlohmann::ordered_json(info.joint)},
                                {"good_counts", info.good_counts.text()}, {"remark", info.remark}, {"options", options}};
    j["max_dimensions"] = info.max_dimensions == std::numeric_limits<std::uint32_t>::max() ? nlohmann::ordered_json() : nlohmann::ordered_json(info.max_dimensions);
    j["max_samples"] = info.max_samples == std::numeric_limits<std::uint64_t>::max() ? nlohmann::ordered_json() : nlohmann::ordered_json(info.max_samples);
    return j;
}

int run_samplers(bool json, const Registry& registry) {
    if (json) {
        nlohmann::ordered_json all = nlohmann::ordered_json::array();
        for (const SamplerInfo& info : registry.infos()) {
            all.push_back(json_of(info));
            all.back()["vectorised"] = registry.vectorised(info.name);
        }
        fmt::print("{}\n", all.dump(2));
        return 0;
    }
    for (const SamplerInfo& info : registry.infos()) {
        fmt::print("{}  ({})\n", info.name, info.title);
        fmt::print("    {}; good counts: {}; drawn jointly: {}; dimensions: {}; samples: {}; fill: {}\n", text(info.kind), info.good_counts.text(),
                   info.joint == 0 ? "all" : std::to_string(info.joint), limit(info.max_dimensions), limit(info.max_samples),
                   registry.vectorised(info.name) ? "vector" : "scalar");
        fmt::print("    {}\n", info.paper);
        if (!info.remark.empty()) fmt::print("    {}\n", info.remark);
        for (const OptionInfo& o : info.options) {
            std::string values;
            for (const std::string& v : o.values) values += (values.empty() ? "" : "|") + v;
            fmt::print("    {}={} (default {})  {}\n", o.name, values, o.default_value, o.help);
        }
    }
    return 0;
}

}  // namespace koksma
