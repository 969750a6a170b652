#include "summary.h"

#include "curve.h"
#include "json_error.h"

#include <koksma/measure/ratio.h>
#include <koksma/measure/rmse_estimate.h>
#include <koksma/measure/slope.h>
#include <koksma/measure/spread.h>
#include <koksma/measure/tails.h>
#include <koksma/measure/time_to.h>
#include <koksma/sampling/error.h>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <functional>
#include <map>

namespace koksma {

namespace {

using Json = nlohmann::ordered_json;

Json point_json(const Point& p, bool randomized, const Curve& baseline) {
    const RmseEstimate mse = rmse_estimate(replicates(p.mse, randomized), kConfidence);
    const Estimate relmse = metric_estimate(replicates(p.relmse, randomized), kConfidence);
    const Estimate cpu = mean_estimate(p.cpu, kConfidence), wall = mean_estimate(p.wall, kConfidence);
    return {{"spp", p.spp},
            {"replicates", p.mse.size()},
            {"rmse", number(mse.rmse.value)},
            {"rmse_lo", number(mse.rmse.lo)},
            {"rmse_hi", number(mse.rmse.hi)},
            {"mse", mse.mean_mse},
            {"relmse", number(relmse.value)},
            {"relmse_lo", number(relmse.lo)},
            {"relmse_hi", number(relmse.hi)},
            {"cpu_seconds", cpu.value},
            {"cpu_seconds_lo", number(cpu.lo)},
            {"cpu_seconds_hi", number(cpu.hi)},
            {"wall_seconds", wall.value},
            {"sampler_share", cpu.value > 0.0 ? mean_estimate(p.sampler, kConfidence).value / cpu.value : 0.0},
            {"fill", p.fills.size() == 1 ? p.fills.front() : "several"},
            {"efficiency", efficiency_json(p, randomized)},
            {"ns_per_path", p.paths > 0 ? Json(1e9 * cpu.value / static_cast<double>(p.paths)) : Json()},
            {"metrics", metrics_json(p, randomized, baseline)},
            {"below_floor", mse.below_floor}};
}

Json slope_json(const Curve& curve, bool randomized) {
    std::vector<RatePoint> points;
    for (const auto& [spp, p] : curve)
        if (spp > 1) points.push_back({static_cast<double>(spp), replicates(p.mse, randomized)});
    const SlopeFit fit = fit_slope(points, kConfidence);
    if (!std::isfinite(fit.value)) return nullptr;
    return {{"value", fit.value},
            {"lo", number(fit.lo)},
            {"hi", number(fit.hi)},
            {"intercept", fit.intercept},
            {"straight_p", number(fit.straight_p)},
            {"spp_from", static_cast<std::uint64_t>(fit.from)},
            {"spp_to", static_cast<std::uint64_t>(fit.to)}};
}

Json times_json(const Curve& curve, bool randomized, const std::vector<double>& targets) {
    std::vector<TimedError> timed;
    for (const auto& [spp, p] : curve) timed.push_back({mean_estimate(p.cpu).value, metric_estimate(replicates(p.relmse, randomized), kConfidence)});
    Json out = Json::array();
    for (const double target : targets) {
        const TimeTo t = time_to(timed, target);
        const char* how = t.how == TimeTo::How::measured ? "measured" : (t.how == TimeTo::How::interpolated ? "interpolated" : "not reached");
        out.push_back({{"relmse", target}, {"seconds", number(t.seconds)}, {"lo", number(t.lo)}, {"hi", number(t.hi)}, {"how", how}, {"reached_relmse", number(t.best_error)}});
    }
    return out;
}

/// MSE of the baseline over that of a sampler at the largest spp that both have.
Json gain_json(const Curve& curve, bool randomized, const Curve& baseline) {
    if (!randomized) return nullptr;
    for (auto it = curve.rbegin(); it != curve.rend(); ++it) {
        const auto other = baseline.find(it->first);
        if (other == baseline.end()) continue;
        const Gain g = gain(it->second.mse, other->second.mse, kConfidence);
        if (g.below_floor) return nullptr;
        return {{"spp", it->first}, {"mse_ratio", number(g.value)}, {"lo", number(g.lo)}, {"hi", number(g.hi)}, {"distinguishable", g.distinguishable()}};
    }
    return nullptr;
}

/// MSE of the baseline over that of a sampler at every count of the sampler. Where the baseline was not run, its error is taken from
/// its neighbours on a straight line in log-log, and the comparison says so.
/// @param own  the good counts of the sampler's own base
Json comparisons_json(const Curve& curve, const Curve& baseline, const Json& own) {
    Json out = Json::array();
    for (const auto& [spp, p] : curve) {
        const auto above = baseline.lower_bound(spp);
        if (above == baseline.end() || (above->first != spp && above == baseline.begin())) continue;  // outside its range
        const bool measured = above->first == spp;
        Gain g;
        if (measured) {
            g = gain(p.mse, above->second.mse, kConfidence);
        } else {
            const auto below = std::prev(above);
            const double from = std::log(static_cast<double>(below->first)), to = std::log(static_cast<double>(above->first));
            g = interpolated_gain(p.mse, below->second.mse, above->second.mse, (std::log(static_cast<double>(spp)) - from) / (to - from), kConfidence);
        }
        out.push_back({{"spp", spp},
                       {"own", std::find(own.begin(), own.end(), spp) != own.end()},
                       {"mse_ratio", number(g.value)},
                       {"lo", number(g.lo)},
                       {"hi", number(g.hi)},
                       {"how", measured ? "measured" : "interpolated"}});
    }
    return out;
}

/// For each count: the RMSE of the plan's layout, that of each permuted one, how far they lie apart, and whether the plan's is better
/// than they are.
Json layouts_json(const std::vector<Row>& rows, const std::string& scene, const std::string& sampler, int layouts) {
    std::vector<Curve> curves;
    for (int layout = 0; layout < layouts; ++layout) curves.push_back(curve_of(rows, scene, sampler, layout));
    Json out = Json::array();
    for (const auto& [spp, plan] : curves.front()) {
        std::vector<std::vector<double>> groups;
        Json each = Json::array();
        for (const Curve& curve : curves) {
            const auto at = curve.find(spp);
            if (at == curve.end()) throw Error(fmt::format("the results hold no render of {} by {} at {} spp with layout {}", scene, sampler, spp, each.size()));
            const Estimate rmse = rmse_estimate(at->second.mse, kConfidence).rmse;
            each.push_back({{"rmse", number(rmse.value)}, {"lo", number(rmse.lo)}, {"hi", number(rmse.hi)}});
            if (each.size() > 1) groups.push_back(at->second.mse);
        }
        const Spread s = spread(plan.mse, groups, kConfidence);
        out.push_back({{"spp", spp},
                       {"permuted", groups.size()},
                       {"rmse", number(s.rmse)},
                       {"lowest", number(s.lowest)},
                       {"highest", number(s.highest)},
                       {"spread", {{"value", number(s.between.value)}, {"lo", number(s.between.lo)}, {"hi", number(s.between.hi)}}},
                       {"p_equal", number(s.p_equal)},
                       {"plan_over_permuted", {{"value", number(s.first.value)}, {"lo", number(s.first.lo)}, {"hi", number(s.first.hi)}}},
                       {"each", each}});
    }
    return out;
}

bool tails_of(const Curve& curve) {
    std::vector<std::vector<double>> points;
    for (const auto& [spp, p] : curve) points.push_back(p.mse);
    return heavy_tailed(points);
}

/// What intervals were seen to cover where the curve looks heavy-tailed; null where it does not.
Json coverage_json(const Curve& curve) {
    if (!tails_of(curve)) return nullptr;
    std::size_t fewest = curve.begin()->second.mse.size();
    for (const auto& [spp, p] : curve) fewest = std::min(fewest, p.mse.size());
    const MeasuredCoverage c = heavy_tailed_coverage(static_cast<int>(fewest));
    return {{"replicates", c.replicates}, {"rmse", c.rmse}, {"slope", c.slope}, {"gain", c.gain}};
}

std::string label_of(const Json& header, const std::string& sampler) {
    for (const Json& s : header.at("samplers"))
        if (s.at("sampler") == sampler) return s.at("label");
    return sampler;
}

/// The first row of a scene: what all its rows have in common.
const Row* first_row(const std::vector<Row>& rows, const std::string& scene, const std::string& sampler = {}) {
    for (const Row& r : rows)
        if (r.scene == scene && (sampler.empty() || r.sampler == sampler)) return &r;
    return nullptr;
}

}  // namespace

Json summarize(const Json& header, const std::vector<Row>& rows) {
    Json summary = {{"schema", 1}, {"experiment", header.at("experiment")}, {"scenes", Json::array()}, {"other_commits", Json::array()}};
    summary["experiment"]["confidence"] = kConfidence;
    std::uint64_t invalid = 0;
    double seconds = 0.0;
    std::map<std::string, std::size_t> commits;
    std::vector<std::vector<Contender>> contenders;
    std::string baseline;
    for (const Json& s : header.at("samplers"))
        if (s.at("sampler") == "random") baseline = "random";
    for (const Row& r : rows) {
        invalid += r.invalid_samples;
        seconds += r.wall_seconds;
        ++commits[r.commit];
    }
    for (const Json& scene : header.at("scenes")) {
        const std::string name = scene.at("name");
        const Row* first = first_row(rows, name);
        if (first == nullptr) continue;
        Json out = scene;
        out["effects"] = first->effects;
        out["dimensions"] = first->dimensions;
        out["kernel"] = first->kernel;
        contenders.emplace_back();
        const Curve base_curve = curve_of(rows, name, baseline);
        Json samplers = Json::array();
        std::map<std::string, Json> slopes;
        for (const Json& s : header.at("samplers")) {
            const std::string spec = s.at("sampler");
            const Row* row = first_row(rows, name, spec);
            if (row == nullptr) continue;
            const Curve curve = curve_of(rows, name, spec);
            contenders.back().push_back({spec, row->randomized, curve});
            Json points = Json::array();
            for (const auto& [spp, p] : curve) points.push_back(point_json(p, row->randomized, base_curve));
            Json entry = {{"sampler", spec},
                          {"label", label_of(header, spec)},
                          {"randomized", row->randomized},
                          {"points", points},
                          {"heavy_tailed", row->randomized && tails_of(curve)},
                          {"slope", slope_json(curve, row->randomized)},
                          {"time_to", times_json(curve, row->randomized, header.at("relmse_targets"))},
                          {"equal_time_vs_random", spec == baseline || base_curve.empty() ? Json() : equal_time_json(curve, row->randomized, base_curve)},
                          {"gain_vs_random", spec == baseline ? Json() : gain_json(curve, row->randomized, base_curve)}};
            const Json& crops = scene.at("crops");
            entry["crop"] = crops.contains(spec) ? crops.at(spec) : Json();
            entry["crop_spp"] = header.at("crop_spp");
            const int layouts = header.value("layouts", 1);
            entry["layouts"] = layouts > 1 && row->randomized ? layouts_json(rows, name, spec, layouts) : Json();
            entry["any_count"] = header.value("any_count", false) && row->randomized && spec != baseline && !base_curve.empty()
                                     ? comparisons_json(curve, base_curve, s.value("own_counts", Json::array()))
                                     : Json();
            entry["progressive"] = progressive_json(curve_of(rows, name, spec, 0, true));
            entry["interval_coverage"] = row->randomized ? coverage_json(curve) : Json();
            slopes[spec] = entry["slope"];
            samplers.push_back(entry);
        }
        out["samplers"] = samplers;
        const std::string needed = scene.contains("effects_of") && scene.at("effects_of").is_string() ? scene.at("effects_of").get<std::string>() : "";
        out["cost_of_effects"] = needed.empty() ? Json() : effects_json(rows, needed, name);
        out["pairs"] = pairs_json(contenders.back());
        out["predictions"] = verdicts_json(scene.value("predictions", Json::array()), contenders.back(), slopes, [&](const std::string& spec) { return label_of(header, spec); });
        out["predictions_verdict"] = worst_verdict(out["predictions"]);
        out.erase("crops");
        summary["scenes"].push_back(out);
    }
    summary["across_scenes"] = across_scenes_json(contenders, baseline);
    for (const auto& [commit, count] : commits)
        if (commit != header.at("experiment").at("commit")) summary["other_commits"].push_back({{"commit", commit}, {"rows", count}});
    summary["rows"] = rows.size();
    summary["invalid_samples"] = invalid;
    summary["seconds_total"] = seconds;
    return summary;
}

void read_results(const std::filesystem::path& file, Json& header, std::vector<Row>& rows) {
    std::ifstream in(file);
    if (!in) throw Error(fmt::format("cannot read {}; expected a folder that koksma bench wrote", file.string()));
    std::size_t number = 0;
    for (std::string line; std::getline(in, line);) {
        ++number;
        try {
            const Json json = Json::parse(line);
            if (json.at("kind") == "header")
                header = json;
            else if (json.at("kind") == "render")
                rows.push_back(json.get<Row>());
        } catch (const Json::exception& e) {
            throw Error(fmt::format("{}:{}: not a row of results: {}", file.string(), number, text_of(e)));
        }
    }
    if (header.is_null() || rows.empty()) throw Error(fmt::format("{} holds no results", file.string()));
}

}  // namespace koksma
