#include "progress.h"
#include "summary.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <map>
#include <set>
#include <string>
#include <vector>

namespace koksma {

namespace {

using Json = nlohmann::ordered_json;

std::string with_interval(const Json& value, const Json& lo, const Json& hi, const char* format) {
    if (value.is_null()) return "-";
    std::string out = fmt::format(fmt::runtime(format), value.get<double>());
    if (!lo.is_null() && !hi.is_null()) out += fmt::format(" [{}, {}]", fmt::format(fmt::runtime(format), lo.get<double>()), fmt::format(fmt::runtime(format), hi.get<double>()));
    return out;
}

/// "1.23e-02 +-4 %": the half-width of the interval as a fraction of the value.
std::string with_percent(const Json& value, const Json& lo, const Json& hi) {
    if (value.is_null()) return "below floor";
    const double v = value;
    std::string out = fmt::format("{:.3e}", v);
    if (!lo.is_null() && !hi.is_null()) out += fmt::format(" +-{:.1f} %", 50.0 * (hi.get<double>() - lo.get<double>()) / v);
    return out;
}

void print_scene(const Json& scene) {
    fmt::print("\n{}: crop {}x{} of {}x{}, {} dimensions, kernel {}\n", scene.at("name").get<std::string>(), scene.at("crop")[2].get<int>(), scene.at("crop")[3].get<int>(),
               scene.at("film")[0].get<int>(), scene.at("film")[1].get<int>(), scene.at("dimensions").get<int>(), scene.at("kernel").get<std::string>());
    fmt::print("  {:<29}{:>5} {:>5}  {:<20}{:<20}{:>11}{:>11}{:>9}\n", "sampler", "spp", "runs", "RMSE", "relMSE", "CPU s", "wall s", "sampler");
    for (const Json& s : scene.at("samplers"))
        for (const Json& p : s.at("points"))
            fmt::print("  {:<29}{:>5} {:>5}  {:<20}{:<20}{:>11.4f}{:>11.4f}{:>7.1f} %\n", s.at("sampler").get<std::string>(), p.at("spp").get<std::uint64_t>(),
                       p.at("replicates").get<int>(), with_percent(p.at("rmse"), p.at("rmse_lo"), p.at("rmse_hi")),
                       with_percent(p.at("relmse"), p.at("relmse_lo"), p.at("relmse_hi")), p.at("cpu_seconds").get<double>(), p.at("wall_seconds").get<double>(),
                       100.0 * p.at("sampler_share").get<double>());
}

void print_rates(const Json& scene) {
    for (const Json& s : scene.at("samplers")) {
        const Json& slope = s.at("slope");
        const Json& gain = s.at("gain_vs_random");
        std::string gain_text = "baseline";
        if (s.at("sampler") != "random") {
            gain_text = gain.is_null() ? (s.at("randomized").get<bool>() ? "below floor" : "no interval without a randomisation") : with_interval(gain.at("mse_ratio"), gain.at("lo"), gain.at("hi"), "{:.2f}");
            if (!gain.is_null() && !gain.at("distinguishable").get<bool>()) gain_text += " not distinguishable";
        }
        std::string times;
        for (const Json& t : s.at("time_to"))
            times += fmt::format("{:>12}", t.at("seconds").is_null() ? "not reached" : fmt::format("{}{:.3g}", t.at("how") == "measured" ? "<= " : "", t.at("seconds").get<double>()));
        if (s.at("heavy_tailed").get<bool>()) times += "  tails";
        fmt::print("  {:<12}{:<29}{:<26}{:<38}{}\n", scene.at("name").get<std::string>(), s.at("sampler").get<std::string>(),
                   slope.is_null() ? "-" : with_interval(slope.at("value"), slope.at("lo"), slope.at("hi"), "{:.3f}"), gain_text, times);
    }
}

/// Whom nobody is told to beat. @param pairs  of one scene
std::vector<std::string> leaders_of(const Json& pairs) {
    std::vector<std::string> all;
    std::set<std::string> beaten;
    for (const Json& p : pairs)
        for (const char* side : {"a", "b"}) {
            const auto sampler = p.at(side).get<std::string>();
            if (std::find(all.begin(), all.end(), sampler) == all.end()) all.push_back(sampler);
            if (!p.at("better").is_null() && p.at("better") != p.at(side)) beaten.insert(sampler);
        }
    all.erase(std::remove_if(all.begin(), all.end(), [&](const std::string& s) { return beaten.count(s) > 0; }), all.end());
    return all;
}

/// Who is told apart from whom at the largest common spp, and who is not; of many pairs, how many and who leads.
void print_pairs(const Json& scene) {
    constexpr std::size_t kMost = 15;  // those of six samplers
    const Json& pairs = scene.at("pairs");
    const auto name = scene.at("name").get<std::string>();
    if (pairs.empty()) return;
    std::string better, alike;
    std::size_t apart = 0;
    for (const Json& p : pairs) {
        const auto a = p.at("a").get<std::string>(), b = p.at("b").get<std::string>();
        if (p.at("better").is_null()) {
            alike += (alike.empty() ? "" : "; ") + a + " and " + b;
        } else {
            better += (better.empty() ? "" : "; ") + (p.at("better") == p.at("a") ? a + " over " + b : b + " over " + a);
            ++apart;
        }
    }
    if (pairs.size() <= kMost)
        fmt::print("  {:<12}better: {}\n  {:<12}not distinguishable: {}\n", name, better.empty() ? "none" : better, "",
                   alike.empty() ? "none" : alike);
    else
        fmt::print("  {:<12}{} of {} pairs told apart; nobody is told to beat {}\n", name, apart, pairs.size(),
                   fmt::join(leaders_of(pairs), ", "));
}

void print_across(const Json& summary) {
    if (summary.at("scenes").size() < 2 || summary.at("across_scenes").empty()) return;
    fmt::print("\nAcross these {} scenes: MSE gain over random, geometric mean, lowest and highest (of other scenes this says nothing)\n", summary.at("scenes").size());
    for (const Json& s : summary.at("across_scenes"))
        if (!s.at("geometric_mean").is_null())
            fmt::print("  {:<29}{:>10.3g}{:>10.3g}{:>10.3g}   {} scenes{}\n", s.at("sampler").get<std::string>(), s.at("geometric_mean").get<double>(), s.at("lowest").get<double>(),
                       s.at("highest").get<double>(), s.at("scenes").get<int>(), s.at("left_out") == 0 ? "" : fmt::format(", {} without a gain left out", s.at("left_out").get<int>()));
}

/// Each claim of a scene's predictions with its verdict and the figures it rests on.
void print_predictions(const Json& scene) {
    if (scene.at("predictions").empty()) return;
    fmt::print("  {:<12}{}\n", scene.at("name").get<std::string>(), scene.at("predictions_verdict").get<std::string>());
    for (const Json& p : scene.at("predictions")) {
        std::string figures;
        for (const Json& f : p.at("found")) {
            if (p.at("found").size() > 4 && f.at("verdict") == "held") continue;  // of many, those that did not hold
            figures += (figures.empty() ? "" : ", ") + (p.at("found").size() > 1 ? f.at("what").get<std::string>() + " " : std::string()) +
                       with_interval(f.at("value"), f.at("lo"), f.at("hi"), "{:.3g}");
        }
        fmt::print("    {:<11}{}: {}\n", p.at("verdict").get<std::string>(), p.at("says").get<std::string>(), figures.empty() ? "all" : figures);
    }
}

/// Equal CPU seconds, and slopes of progressive renders: a line a sampler.
void print_equal_time(const Json& scene) {
    for (const Json& s : scene.at("samplers")) {
        const Json& e = s.at("equal_time_vs_random");
        if (e.is_null()) continue;
        fmt::print("  {:<12}{:<29}{:>9.3g} s   {}\n", scene.at("name").get<std::string>(), s.at("sampler").get<std::string>(), e.at("seconds").get<double>(),
                   with_interval(e.at("mse_ratio"), e.at("lo"), e.at("hi"), "{:.3g}"));
    }
}

void print_progressive(const Json& scene) {
    for (const Json& s : scene.at("samplers")) {
        const Json& p = s.at("progressive");
        if (p.is_null() || p.at("slope").is_null()) continue;
        const Json& slope = p.at("slope");
        fmt::print("  {:<12}{:<29}{:<26}{} renders to {} spp\n", scene.at("name").get<std::string>(), s.at("sampler").get<std::string>(),
                   with_interval(slope.at("value"), slope.at("lo"), slope.at("hi"), "{:.3f}"), p.at("renders").get<int>(), p.at("planned_spp").get<std::uint64_t>());
    }
}

/// How much of a result is luck of dimensions: a line a sampler and count.
void print_layouts(const Json& scene) {
    for (const Json& s : scene.at("samplers")) {
        if (s.at("layouts").is_null()) continue;
        for (const Json& l : s.at("layouts")) {
            const Json& spread = l.at("spread");
            const Json& plan = l.at("plan_over_permuted");
            const auto percent = [](const Json& x) { return x.is_null() ? std::string("-") : fmt::format("{:.1f}", 100.0 * x.get<double>()); };
            const auto rmse = [](const Json& x) { return x.is_null() ? std::string("below floor") : fmt::format("{:.3e}", x.get<double>()); };
            std::string verdict;
            if (!spread.at("lo").is_null() && spread.at("lo") == 0.0) verdict = "layouts not distinguishable";
            fmt::print("  {:<12}{:<29}{:>5}  {:<12}{:<12}{:<12}{:<22}{:<24}{}\n", scene.at("name").get<std::string>(), s.at("sampler").get<std::string>(),
                       l.at("spp").get<std::uint64_t>(), rmse(l.at("rmse")), rmse(l.at("lowest")), rmse(l.at("highest")),
                       fmt::format("{} [{}, {}] %", percent(spread.at("value")), percent(spread.at("lo")), percent(spread.at("hi"))),
                       with_interval(plan.at("value"), plan.at("lo"), plan.at("hi"), "{:.3f}"), verdict);
        }
    }
}

/// MSE gains over random at every count, samplers as columns.
void print_counts(const Json& scene) {
    constexpr int kWidth = 28;
    std::map<std::uint64_t, std::vector<std::string>> lines;
    std::vector<std::string> names;
    for (const Json& s : scene.at("samplers")) {
        if (s.at("any_count").is_null()) continue;
        names.push_back(s.at("sampler").get<std::string>());
        for (const Json& c : s.at("any_count")) {
            std::vector<std::string>& line = lines[c.at("spp").get<std::uint64_t>()];
            line.resize(names.size());
            line.back() = with_interval(c.at("mse_ratio"), c.at("lo"), c.at("hi"), "{:.3g}") + (c.at("own").get<bool>() ? "*" : "") +
                          (c.at("how") == "interpolated" ? "~" : "");
        }
    }
    if (names.empty()) return;
    fmt::print("\n{}: MSE gain over random [95 %] at any count; * a good count of the sampler's own base; ~ random was not run there, its error is\n"
               "interpolated\n{:>7}  ", scene.at("name").get<std::string>(), "spp");
    for (std::string name : names) {
        if (name.size() + 1 > kWidth) name.resize(kWidth - 1);
        fmt::print("{:<{}}", name, kWidth);
    }
    fmt::print("\n");
    for (const auto& [spp, cells] : lines) {
        fmt::print("{:>7}  ", spp);
        for (const std::string& cell : cells) fmt::print("{:<{}}", cell.empty() ? "." : cell, kWidth);
        fmt::print("\n");
    }
}

/// What the effects cost that a scene does not call for: a line a sampler and count.
void print_effects(const Json& scene) {
    const Json& cost = scene.at("cost_of_effects");
    if (cost.is_null()) return;
    fmt::print("  {}: {} effects, {} dimensions, {} -> {} effects, {} dimensions, {}\n", scene.at("effects_of").get<std::string>(), cost.at("needed").size(),
               cost.at("dimensions_needed").get<int>(), cost.at("kernel_needed").get<std::string>(), cost.at("forced").size(), cost.at("dimensions").get<int>(),
               cost.at("kernel").get<std::string>());
    for (const Json& l : cost.at("lines")) {
        const Json &time = l.at("time_ratio"), &error = l.at("mse_ratio");
        fmt::print("    {:<29}{:>5} {:>9.0f}{:>9.0f}  {:<24}{:<24}{}\n", l.at("sampler").get<std::string>(), l.at("spp").get<std::uint64_t>(),
                   l.at("ns_per_path_needed").get<double>(), l.at("ns_per_path").get<double>(), with_interval(time.at("value"), time.at("lo"), time.at("hi"), "{:.3f}"),
                   with_interval(error.at("value"), error.at("lo"), error.at("hi"), "{:.3f}"), l.at("distinguishable").get<bool>() ? "distinguishable" : "");
    }
}

template <class F>
bool any_sampler(const Json& summary, F&& holds) {
    for (const Json& scene : summary.at("scenes"))
        for (const Json& s : scene.at("samplers"))
            if (holds(s)) return true;
    return false;
}

}  // namespace

void print_tables(const Json& summary) {
    for (const Json& scene : summary.at("scenes")) print_scene(scene);
    if (summary.at("scenes").empty()) return;
    std::string targets;
    for (const Json& t : summary.at("scenes")[0].at("samplers")[0].at("time_to")) targets += fmt::format("{:>12}", fmt::format("{:g}", t.at("relmse").get<double>()));
    fmt::print("\nRates (log RMSE against log spp, 1 spp left out), MSE gain over random at the largest spp, CPU seconds to reach a relMSE of\n");
    fmt::print("  {:<12}{:<29}{:<26}{:<38}{}\n", "scene", "sampler", "slope [95 %]", "gain [95 %]", targets);
    for (const Json& scene : summary.at("scenes")) print_rates(scene);
    if (any_sampler(summary, [](const Json& s) { return s.at("heavy_tailed").get<bool>(); }))
        fmt::print("  tails: single replicates stand far above the others; of such laws 95 % intervals were seen to cover less (summary.json: interval_coverage)\n");
    if (any_sampler(summary, [](const Json& s) { return !s.at("equal_time_vs_random").is_null(); })) {
        fmt::print("\nMSE gain over random after equal CPU seconds [95 % of the errors; the seconds taken as known], interpolated, never extrapolated\n");
        for (const Json& scene : summary.at("scenes")) print_equal_time(scene);
    }
    if (any_sampler(summary, [](const Json& s) { return !s.at("progressive").is_null(); })) {
        fmt::print("\nProgressive renders, read at every spp: slopes [95 % by leaving out whole renders]\n");
        for (const Json& scene : summary.at("scenes")) print_progressive(scene);
    }
    fmt::print("\nPairs at their largest common spp (MSE; p of all pairs of a scene corrected by Holm's method, 5 %)\n");
    for (const Json& scene : summary.at("scenes")) print_pairs(scene);
    print_across(summary);
    std::size_t predicted = 0;
    for (const Json& scene : summary.at("scenes")) predicted += scene.at("predictions").size();
    if (predicted > 0) fmt::print("\nPredictions of the experiment, made before it ran\n");
    for (const Json& scene : summary.at("scenes")) print_predictions(scene);
    for (const Json& scene : summary.at("scenes")) print_counts(scene);
    if (any_sampler(summary, [](const Json& s) { return !s.at("layouts").is_null(); })) {
        fmt::print("\nLuck of dimensions: RMSE over permuted layouts (geometric mean, lowest, highest), their standard deviation without the replicates'\n"
                   "noise, and the RMSE of the layout as planned over that of the permuted ones [95 %]\n");
        fmt::print("  {:<12}{:<29}{:>5}  {:<12}{:<12}{:<12}{:<22}{:<24}\n", "scene", "sampler", "spp", "RMSE", "lowest", "highest", "spread [95 %]",
                   "planned/permuted [95 %]");
        for (const Json& scene : summary.at("scenes")) print_layouts(scene);
    }
    if (std::any_of(summary.at("scenes").begin(), summary.at("scenes").end(), [](const Json& s) { return !s.at("cost_of_effects").is_null(); })) {
        fmt::print("\nEffects that nothing calls for: nanoseconds a path with the needed ones and with more, the ratio of the times of renders that were made one\n"
                   "after the other [95 %], and MSE with more over MSE with the needed ones [95 %]\n");
        fmt::print("    {:<29}{:>5} {:>9}{:>9}  {:<24}{:<24}\n", "sampler", "spp", "needed", "more", "time [95 %]", "MSE [95 %]");
        for (const Json& scene : summary.at("scenes")) print_effects(scene);
    }
    if (const auto invalid = summary.at("invalid_samples").get<std::uint64_t>(); invalid > 0) fmt::print("\n{} invalid samples (they count as zero); koksma render --stats locates them\n", invalid);
}

}  // namespace koksma
