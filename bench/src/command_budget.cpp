#include "budget.h"
#include "curve.h"
#include "machine.h"
#include "obtain_reference.h"
#include "page.h"
#include "progress.h"
#include "scene_setup.h"

#include <koksma/film/atomic_file.h>
#include <koksma/measure/rmse_estimate.h>
#include <koksma/measure/tails.h>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>

namespace koksma {

namespace {

using Json = nlohmann::ordered_json;

/// A scene of the default experiment by name, or a file.
BenchScene scene_of(const BudgetCommand& command, const Experiment& experiment) {
    if (command.scene.extension() != ".xml") return std::move(open_scenes(experiment, {command.scene.string()}).front());
    const Scene scene = compile(load_scene(command.scene));
    return open_scene({.file = command.scene, .name = command.scene.stem().string(), .crop = crop_of(scene.film)});
}

Json estimate_json(const std::vector<double>& mse) {
    const Estimate e = metric_estimate(mse, kConfidence);
    Json out = interval_json(e.value, e.lo, e.hi);
    out["heavy_tailed"] = heavy_tailed({mse});
    return out;
}
Json gain_json(const Gain& g) { return interval_json(g.value, g.lo, g.hi); }

Json budget_json(const Budget& b) {
    Json divisions = Json::array();
    for (std::size_t d = 0; d < b.divisions.size(); ++d) {
        Json groups = Json::array();
        for (std::size_t g = 0; g < b.groups[d].size(); ++g) {
            const GroupBudget& group = b.groups[d][g];
            const SlotSet& slots = b.divisions[d].groups[g].slots;
            groups.push_back({{"name", b.divisions[d].groups[g].name},
                              {"slots", std::count(slots.begin(), slots.end(), true)},
                              {"only", estimate_json(group.only)},
                              {"all_but", estimate_json(group.all_but)},
                              {"removed", gain_json(share(group.only, b.independent))},
                              {"gain", gain_json(gain(group.only, b.independent))},
                              {"added", gain_json(share(b.sequence, group.all_but))},
                              {"loss", gain_json(gain(b.sequence, group.all_but))}});
        }
        divisions.push_back({{"by", b.divisions[d].by}, {"groups", groups}});
    }
    return {{"independent", estimate_json(b.independent)},
            {"sequence", estimate_json(b.sequence)},
            {"gain", gain_json(gain(b.sequence, b.independent))},
            {"divisions", divisions}};
}

std::string text(const Json& e, const char* format, double factor = 1.0) {
    if (e.at("value").is_null()) return "below floor";
    const auto one = [&](const char* key) {
        return e.at(key).is_null() ? "?" : fmt::format(fmt::runtime(format), factor * e.at(key).get<double>());
    };
    return fmt::format("{} [{}, {}]", one("value"), one("lo"), one("hi"));
}

void print_budget(const Json& all) {
    const Json& b = all.at("budget");
    fmt::print("{}, {} spp, {} replicates; 95 % intervals over replicates\n", all.at("sampler").get<std::string>(),
               all.at("spp").get<std::uint64_t>(), all.at("replicates").get<int>());
    fmt::print("  MSE of independent numbers {}, of the sequence {}: a gain of {}\n", text(b.at("independent"), "{:.3g}"),
               text(b.at("sequence"), "{:.3g}"), text(b.at("gain"), "{:.2f}"));
    for (const Json& d : b.at("divisions")) {
        fmt::print("\n  by {:<31}{:>6}  {:<38}{}\n", d.at("by").get<std::string>(), "slots", "it alone by the sequence: MSE falls by",
                   "it alone independent: MSE grows to");
        for (const Json& g : d.at("groups"))
            fmt::print("  {:<34}{:>6}  {:<38}{}\n", g.at("name").get<std::string>(), g.at("slots").get<int>(),
                       text(g.at("removed"), "{:.1f} %", 100.0), text(g.at("loss"), "{:.2f} x"));
    }
}

}  // namespace

int run_budget(const BudgetCommand& command, const Registry& registry, const std::string& command_line) {
    const Experiment experiment = load_experiment("default");
    const auto sequence = make_sampler(registry, command.sampler), independent = make_sampler(registry, "random");
    if (!sequence->randomized()) throw UsageError(fmt::format("'{}' is not randomized: it has no replicates", sequence->name()));
    if (!sequence->info().good_counts.contains(command.spp))
        fmt::print(stderr, "koksma: note: {} keeps its promise at {}; {} samples per pixel are not\n", sequence->name(),
                   sequence->info().good_counts.text(), command.spp);
    const BenchScene scene = scene_of(command, experiment);
    const std::filesystem::path out =
        command.out.empty() ? std::filesystem::path("koksma-bench") / ("budget-" + scene.what.name) : command.out;
    std::filesystem::create_directories(out);
    require_writable(out / "budget.json");

    const Reference reference = obtain_reference(experiment, scene, registry, command.threads);
    BudgetSettings settings{command.spp, command.replicates, command.bounces, command.seed, command.threads};
    Budget budget;
    {
        Progress progress("budget", true);
        budget = measure_budget(scene, reference, *sequence, *independent, settings, [&](double f) { progress.update(f); });
    }
    const PixelRect& crop = scene.what.crop;
    const Json all = {{"scene", scene.what.name},
                      {"purpose", scene.scene.description.purpose},
                      {"crop", {crop.x, crop.y, crop.width, crop.height}},
                      {"sampler", sequence->name()},
                      {"label", sequence->info().title},
                      {"spp", command.spp},
                      {"replicates", command.replicates},
                      {"seed", command.seed},
                      {"dimensions", scene.plan.layout.dimensions()},
                      {"command", command_line},
                      {"version", version_text()},
                      {"machine", machine().cpu},
                      {"budget", budget_json(budget)}};
    write_json(out / "budget.json", all);
    print_budget(all);
    fmt::print("\nnumbers: {}\n", (out / "budget.json").string());
    if (command.no_report) return 0;
    draw_page("report.budget", out / "budget.json", out / "budget.html");
    return 0;
}

}  // namespace koksma
