#include "commands.h"
#include "scene_setup.h"

#include <koksma/conformance/checks.h>
#include <koksma/sampling/bits.h>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <cstdio>

namespace koksma {

namespace {

using conformance::Finding;
using conformance::Subject;

const char* verdict(const Finding& f) { return !f.applies ? "-" : f.passed ? "held" : "failed"; }

struct Tally {
    int held = 0, failed = 0, without = 0;
    void add(const Finding& f) noexcept { ++(!f.applies ? without : f.passed ? held : failed); }
};

/// One line a check, or with `brief` only those that failed.
nlohmann::ordered_json check_one(const Subject& subject, bool print, bool brief, Tally& total) {
    nlohmann::ordered_json all = nlohmann::ordered_json::array();
    Tally tally;
    if (print && !brief) fmt::print("{}\n", subject.name());
    for (const conformance::Check& check : conformance::all_checks()) {
        const Finding f = check.run(subject);
        tally.add(f);
        total.add(f);
        all.push_back({{"check", check.name}, {"says", check.says}, {"verdict", verdict(f)}, {"numbers", f.numbers}});
        if (print && (!brief || !f.passed))
            fmt::print("  {:<7}{:<13}{}{}\n", verdict(f), check.name, brief ? subject.name() + ": " : "", f.numbers.empty() ? std::string(check.says) : f.numbers);
    }
    if (print) fmt::print("{}{} held, {} failed, {} do not apply\n", brief ? fmt::format("{:<52}", subject.name()) : "  ", tally.held, tally.failed, tally.without);
    if (print) std::fflush(stdout);
    return {{"sampler", subject.name()}, {"held", tally.held}, {"failed", tally.failed}, {"checks", all}};
}

}  // namespace

int run_check(const CheckCommand& command, const Registry& registry) {
    const bool everything = command.sampler == "all";
    if (!everything) (void)make_sampler(registry, command.sampler);  // an unknown name is wrong usage
    nlohmann::ordered_json all = nlohmann::ordered_json::array();
    Tally total;
    std::string skipped;
    for (const SamplerInfo& info : registry.infos()) {
        if (!everything) break;
        if (conformance::needs_a_file(registry, info)) skipped += (skipped.empty() ? "" : ", ") + info.name;
    }
    for (Subject& s : everything ? conformance::subjects(registry) : conformance::subjects(registry, command.sampler)) {
        s.first_seed = command.seed == 0 ? 0 : mix64(command.seed);
        all.push_back(check_one(s, !command.json, everything, total));
    }
    if (command.json)
        fmt::print("{}\n", nlohmann::ordered_json{{"seed", command.seed}, {"held", total.held}, {"failed", total.failed}, {"samplers", all}}.dump(2));
    else if (everything || all.size() > 1)
        fmt::print("{} samplers with their options: {} checks held, {} failed{}\n", all.size(), total.held, total.failed,
                   skipped.empty() ? "" : "; not checked without a file: " + skipped);
    return total.failed == 0 ? 0 : 1;
}

}  // namespace koksma
