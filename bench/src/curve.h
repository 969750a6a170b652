#pragma once
// The rows of one sampler on one scene, by number of samples: what every statistic of a summary starts from.

#include "row.h"

#include <nlohmann/json.hpp>

#include <functional>
#include <map>
#include <string>
#include <vector>

namespace koksma {

inline constexpr double kConfidence = 0.95;

/// The replicates of one sampler at one spp.
struct Point {
    std::uint64_t spp = 0;
    std::vector<Errors> all, masked;
    std::vector<double> mse, relmse, wall, cpu, sampler;
    std::uint64_t invalid = 0, paths = 0;
    std::vector<std::string> fills;  ///< each once
};
using Curve = std::map<std::uint64_t, Point>;  // by spp

/// @param layout    0: as the plan has it
/// @param prefixes  of progressive renders: the k-th value of every point is of one and the same render
[[nodiscard]] Curve curve_of(const std::vector<Row>& rows, const std::string& scene, const std::string& sampler, int layout = 0,
                             bool prefixes = false);

/// One error of all replicates that have it.
[[nodiscard]] std::vector<double> values_of(const std::vector<Errors>& errors, double Errors::*which);

/// Without a randomisation all replicates are one: keep its error, drop the interval.
[[nodiscard]] std::vector<double> replicates(const std::vector<double>& values, bool randomized);

/// null where it is not finite.
[[nodiscard]] nlohmann::ordered_json number(double x);

/// {"value", "lo", "hi"}
[[nodiscard]] nlohmann::ordered_json interval_json(double value, double lo, double hi);

/// A sampler of a scene, as the statistics that compare several see it.
struct Contender {
    std::string sampler;
    bool randomized = true;
    Curve curve;
};

/// What a larger set of effects costs: for each sampler and count, dimensions of both, nanoseconds a path and their ratio, MSE ratio.
/// @param needed, forced  names under which the scene was rendered
[[nodiscard]] nlohmann::ordered_json effects_json(const std::vector<Row>& rows, const std::string& needed, const std::string& forced);

// The parts of a summary; each of one sampler, one scene or all.
[[nodiscard]] nlohmann::ordered_json metrics_json(const Point& point, bool randomized, const Curve& baseline);
[[nodiscard]] nlohmann::ordered_json pairs_json(const std::vector<Contender>& contenders);
/// @param scenes  the contenders of each scene
[[nodiscard]] nlohmann::ordered_json across_scenes_json(const std::vector<std::vector<Contender>>& scenes, const std::string& baseline);

/// 1 / (MSE x CPU seconds), of the means; the seconds' own uncertainty is not in the interval.
[[nodiscard]] nlohmann::ordered_json efficiency_json(const Point& point, bool randomized);
/// MSE of the baseline over that of the sampler after equally many CPU seconds: the most that both were measured for. Between points by
/// straight lines in log-log, never beyond them: null where they have no time in common. The interval is that of the errors; seconds are taken as known.
[[nodiscard]] nlohmann::ordered_json equal_time_json(const Curve& curve, bool randomized, const Curve& baseline);
/// Prefixes of progressive renders: points, and a slope whose interval leaves out one whole render at a time. null without such renders.
[[nodiscard]] nlohmann::ordered_json progressive_json(const Curve& prefixes);
/// The nanoseconds a path of B below which B is more efficient than A at this spp, MSE as measured: ns of A times MSE of A over MSE of B.
[[nodiscard]] nlohmann::ordered_json overtake_json(const Contender& a, const Contender& b, std::uint64_t spp);

/// Verdicts, each with the figures it rests on: "held" where every interval lies within what was said, "refuted" where one lies outside it,
/// "undecided" where one reaches over a bound, "not tested" where something was not rendered.
/// @param predictions  of predictions_json()
/// @param contenders   of the scene
/// @param slopes       by sampler: "value", "lo", "hi", or null
/// @param label        of a sampler, for people
[[nodiscard]] nlohmann::ordered_json verdicts_json(const nlohmann::ordered_json& predictions, const std::vector<Contender>& contenders,
                                                   const std::map<std::string, nlohmann::ordered_json>& slopes,
                                                   const std::function<std::string(const std::string&)>& label);

/// Of several: refuted if one is, else undecided if one is, else held if one is; else not tested.
[[nodiscard]] std::string worst_verdict(const nlohmann::ordered_json& verdicts);

}  // namespace koksma
