// Whether a scene's predictions held.

#include "curve.h"

#include <koksma/measure/ratio.h>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

namespace koksma {

namespace {

using Json = nlohmann::ordered_json;

/// What an interval says of a range.
const char* verdict_of(const Json& found, double least, double most) {
    if (found.is_null() || found.at("lo").is_null() || found.at("hi").is_null()) return "not tested";
    const double lo = found.at("lo"), hi = found.at("hi");
    if (lo >= least && hi <= most) return "held";
    return hi < least || lo > most ? "refuted" : "undecided";
}

std::string range_text(const Json& p) {
    const Json &least = p.at("least"), &most = p.at("most");
    if (least.is_null()) return fmt::format("at most {:g}", most.get<double>());
    if (most.is_null()) return fmt::format("at least {:g}", least.get<double>());
    return fmt::format("between {:g} and {:g}", least.get<double>(), most.get<double>());
}

/// MSE of b over MSE of a at one spp; null where one was not rendered.
Json ratio_json(const std::vector<Contender>& contenders, const std::string& a, const std::string& b, std::uint64_t spp) {
    const auto find = [&](const std::string& name) {
        return std::find_if(contenders.begin(), contenders.end(), [&](const Contender& c) { return c.sampler == name; });
    };
    const auto first = find(a), second = find(b);
    if (first == contenders.end() || second == contenders.end() || !first->curve.contains(spp) || !second->curve.contains(spp))
        return nullptr;
    const Gain g = gain(replicates(first->curve.at(spp).mse, first->randomized), replicates(second->curve.at(spp).mse, second->randomized),
                        kConfidence);
    return interval_json(g.value, g.lo, g.hi);
}

Json found_json(std::string what, Json figure, double least, double most) {
    const char* verdict = verdict_of(figure, least, most);
    if (figure.is_null()) figure = interval_json(NAN, NAN, NAN);
    return {
        {"what", std::move(what)}, {"value", figure.at("value")}, {"lo", figure.at("lo")}, {"hi", figure.at("hi")}, {"verdict", verdict}};
}

}  // namespace

Json verdicts_json(const Json& predictions, const std::vector<Contender>& contenders, const std::map<std::string, Json>& slopes,
                   const std::function<std::string(const std::string&)>& label) {
    Json out = Json::array();
    for (const Json& p : predictions) {
        const std::string of = p.at("of");
        auto samplers = p.at("samplers").get<std::vector<std::string>>();
        const bool all = samplers.empty();
        if (all)
            for (const Contender& c : contenders)
                if (of == "slope" || c.sampler != "random") samplers.push_back(c.sampler);
        const double least = p.at("least").is_null() ? -INFINITY : p.at("least").get<double>(),
                     most = p.at("most").is_null() ? INFINITY : p.at("most").get<double>();
        const std::uint64_t spp = p.at("spp").is_null() ? 0 : p.at("spp").get<std::uint64_t>();
        Json found = Json::array();
        std::vector<std::string> names;
        for (const std::string& s : samplers) names.push_back(label(s));
        for (std::size_t i = 0; i < samplers.size(); ++i) {
            if (of == "slope") {
                const auto at = slopes.find(samplers[i]);
                found.push_back(found_json(names[i], at == slopes.end() ? Json() : at->second, least, most));
            } else if (of == "gain") {
                found.push_back(found_json(names[i], ratio_json(contenders, samplers[i], "random", spp), least, most));
            } else if (i > 0) {
                found.push_back(
                    found_json(names[i] + " / " + names[i - 1], ratio_json(contenders, samplers[i - 1], samplers[i], spp), least, most));
            }
        }
        const std::string who = all ? "every sampler" : fmt::format("{}", fmt::join(names, of == "order" ? " below " : ", "));
        std::string says;
        if (of == "slope") says = fmt::format("slope of {} {}", who, range_text(p));
        if (of == "gain") says = fmt::format("MSE gain over random of {} at {} spp {}", who, spp, range_text(p));
        if (of == "order") says = fmt::format("MSE at {} spp: {}", spp, who);
        // One that was not rendered leaves a claim about several untested, unless another refutes it.
        std::string verdict = found.empty() ? "not tested" : "held";
        for (const char* worse : {"undecided", "not tested", "refuted"})
            for (const Json& f : found)
                if (f.at("verdict") == worse) verdict = worse;
        out.push_back({{"says", says}, {"of", of}, {"verdict", verdict}, {"found", found}});
    }
    return out;
}

std::string worst_verdict(const Json& verdicts) {
    for (const char* verdict : {"refuted", "undecided", "held"})
        for (const Json& v : verdicts)
            if (v.at("verdict") == verdict) return verdict;
    return "not tested";
}

}  // namespace koksma
