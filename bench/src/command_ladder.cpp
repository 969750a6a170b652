#include "commands.h"
#include "experiment.h"
#include "ladder.h"
#include "machine.h"
#include "progress.h"
#include "python.h"

#include <koksma/film/atomic_file.h>
#include <koksma/integrators/lecture/estimator.h>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <chrono>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <string>

namespace koksma {

namespace {

using Json = nlohmann::ordered_json;

/// What a technique shows of a ladder: how far it holds, where it first breaks, how many steps its noise hides.
struct Verdict {
    double holds_to = 0, breaks_at = 0, error = 0;
    bool breaks = false;
    int hidden = 0;
};

Json verdict_json(const Verdict& v) {
    return {{"holds_to", v.holds_to},
            {"breaks_at", v.breaks ? Json(v.breaks_at) : Json(nullptr)},
            {"error_there", v.breaks ? Json(v.error) : Json(nullptr)},
            {"hidden_by_noise", v.hidden}};
}

/// Climbs one ladder. @return  its part of ladder.json
Json climb_all(const Ladder& ladder, const Registry& registry, int threads, int& broken, const std::function<void()>& advance) {
    Json steps = Json::array();
    std::vector<Verdict> verdicts(ladder.techniques.size());
    for (const LadderStep& step : ladder.steps) {
        Json row = {{"x", step.x},
                    {"expected", step.expected},
                    {"spp", step.spp},
                    {"pixels", step.scene.film.width * step.scene.film.height},
                    {"replicates", step.replicates},
                    {"first_sample", step.first},
                    {"sampler", step.sampler},
                    {"techniques", Json::object()}};
        for (std::size_t t = 0; t < ladder.techniques.size(); ++t) {
            const LadderResult r = climb(step, ladder.techniques[t], registry, threads);
            const bool holds = r.holds(ladder.tolerance), tells = r.tells(ladder.tolerance);
            row["techniques"][std::string(name(ladder.techniques[t]))] = {
                {"error", r.error}, {"half_width", r.half_width}, {"invalid", r.invalid}, {"holds", holds}, {"tells", tells}};
            Verdict& v = verdicts[t];
            v.hidden += holds && !tells;
            if (!holds && !v.breaks) {
                v.breaks = true;
                v.breaks_at = step.x;
                v.error = r.error;
                ++broken;
            }
            if (!v.breaks && tells) v.holds_to = step.x;
        }
        steps.push_back(row);
        advance();
    }
    Json out = {{"name", ladder.name},           {"title", ladder.title},      {"axis", ladder.axis}, {"answer", ladder.answer},
                {"tolerance", ladder.tolerance}, {"verdicts", Json::object()}, {"steps", steps}};
    for (std::size_t t = 0; t < ladder.techniques.size(); ++t) {
        const Verdict& v = verdicts[t];
        out["verdicts"][std::string(name(ladder.techniques[t]))] = verdict_json(v);
        const std::string hidden =
            v.hidden > 0 ? fmt::format("; noise above ten tolerances at {} of {}", v.hidden, ladder.steps.size()) : "";
        fmt::print("{:<16} {:<6} {}{}\n", ladder.name, name(ladder.techniques[t]),
                   v.breaks ? fmt::format("BREAKS at {:.3g}: error {:+.2g}", v.breaks_at, v.error)
                            : fmt::format("holds, tolerance {:.0e}", ladder.tolerance),
                   hidden);
    }
    std::fflush(stdout);  // a ladder takes a while
    return out;
}

}  // namespace

int run_ladder(const BenchCommand& command, const Registry& registry, const std::string& command_line) {
    if (!command.samplers.empty() || !command.scenes.empty() || !command.shard.empty())
        throw UsageError("bench ladder has its own scenes and samplers, and no shards");
    const std::vector<Ladder> all = ladders(command.quick);
    std::size_t steps = 0;
    for (const Ladder& l : all) steps += l.steps.size();
    if (command.dry_run) {
        for (const Ladder& l : all) fmt::print("{:<16} {} steps: {}\n", l.name, l.steps.size(), l.title);
        return 0;
    }
    const std::filesystem::path out = command.out.empty() ? std::filesystem::path("koksma-bench/ladder") : command.out;
    std::error_code error;
    std::filesystem::create_directories(out, error);
    if (error) throw Error(fmt::format("cannot make the folder {}: {}", out.string(), error.message()));
    require_writable(out / "ladder.json");

    const auto begin = std::chrono::steady_clock::now();
    const Machine m = machine();
    int broken = 0;
    std::size_t done = 0;
    Json climbed = Json::array();
    {
        Progress progress("ladder", true);
        for (const Ladder& l : all)
            climbed.push_back(climb_all(l, registry, command.threads, broken,
                                        [&] { progress.update(static_cast<double>(++done) / static_cast<double>(steps), l.name); }));
    }
    Json extremes = Json::array();
    std::uint64_t invalid = 0, samples = 0;
    for (const ExtremeResult& e : sweep_extremes(command.quick ? 1 << 14 : 1 << 18, command.threads)) {
        extremes.push_back({{"scene", e.scene}, {"samples", e.samples}, {"invalid", e.invalid}, {"brightest", e.brightest}});
        invalid += e.invalid;
        samples += e.samples;
    }
    fmt::print("{:<16} {:<6} {} of {} samples of numbers at 0, 2^-24, 1/2 and 1 - 2^-24 are invalid\n", "extremes", "mis", invalid,
               samples);
    const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    const Json ladder = {{"command", command_line}, {"version", version_text()}, {"commit", commit()}, {"machine", m.cpu},
                         {"cores", m.cores},        {"compiler", m.compiler},    {"confidence", 0.99}, {"seconds", seconds},
                         {"ladders", climbed},      {"extremes", extremes}};
    write_atomically(out / "ladder.json", [&](const std::filesystem::path& file) {
        std::ofstream stream(file);
        stream << ladder.dump(1) << '\n';
        stream.flush();
        if (!stream) throw Error("the disk is full or the folder is not writable");
    });
    fmt::print("{} techniques of {} ladders break; {:.0f} s\nnumbers: {}\n", broken, all.size(), seconds, (out / "ladder.json").string());
    if (command.no_report) return 0;
    const std::string page = (out / "ladder.html").string();
    const int code = run_python({"-m", "report.ladder", (out / "ladder.json").string(), page}, (data_directory() / "bench").string());
    if (code != 0)
        throw Error(fmt::format("the numbers are complete, but '{} -m report.ladder' ended with code {}", python_program(), code));
    return 0;
}

}  // namespace koksma
