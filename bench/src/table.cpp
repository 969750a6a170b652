#include "progress.h"
#include "summary.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

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
    fmt::print("  {:<24}{:>5} {:>5}  {:<20}{:<20}{:>11}{:>11}{:>9}\n", "sampler", "spp", "runs", "RMSE", "relMSE", "CPU s", "wall s", "sampler");
    for (const Json& s : scene.at("samplers"))
        for (const Json& p : s.at("points"))
            fmt::print("  {:<24}{:>5} {:>5}  {:<20}{:<20}{:>11.4f}{:>11.4f}{:>7.1f} %\n", s.at("sampler").get<std::string>(), p.at("spp").get<std::uint64_t>(),
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
        fmt::print("  {:<10}{:<24}{:<26}{:<38}{}\n", scene.at("name").get<std::string>(), s.at("sampler").get<std::string>(),
                   slope.is_null() ? "-" : with_interval(slope.at("value"), slope.at("lo"), slope.at("hi"), "{:.3f}"), gain_text, times);
    }
}

}  // namespace

void print_tables(const Json& summary) {
    for (const Json& scene : summary.at("scenes")) print_scene(scene);
    if (summary.at("scenes").empty()) return;
    std::string targets;
    for (const Json& t : summary.at("scenes")[0].at("samplers")[0].at("time_to")) targets += fmt::format("{:>12}", fmt::format("{:g}", t.at("relmse").get<double>()));
    fmt::print("\nRates (log RMSE against log spp, 1 spp left out), MSE gain over random at the largest spp, CPU seconds to reach a relMSE of\n");
    fmt::print("  {:<10}{:<24}{:<26}{:<38}{}\n", "scene", "sampler", "slope [95 %]", "gain [95 %]", targets);
    for (const Json& scene : summary.at("scenes")) print_rates(scene);
    if (const auto invalid = summary.at("invalid_samples").get<std::uint64_t>(); invalid > 0) fmt::print("\n{} invalid samples (they count as zero); koksma render --stats locates them\n", invalid);
}

}  // namespace koksma
