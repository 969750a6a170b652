// Every mutant is rejected by at least one check, and none of the healthy samplers that they are made from by any.
// The table says which checks reject which mutant: the first three, or all of them if KOKSMA_ALL_KILLERS is set. Seeds are fixed.

#include "mutant.h"

#include <koksma/conformance/checks.h>

#include <koksma_catch.h>

#include <cstdio>
#include <cstdlib>
#include <exception>

using namespace koksma;
using namespace koksma::conformance;
using namespace koksma::mutation;

namespace {

/// The names of the checks that reject a sampler, cheap ones first, as many as are wanted. A check that throws has not judged: it
/// counts as a crash.
std::string rejected_by(const Subject& subject, std::string& crashes, int wanted) {
    std::string names;
    int found = 0;
    for (const Check& check : all_checks()) {
        if (found == wanted) return names + " ..";
        try {
            const Finding finding = check.run(subject);
            if (finding.passed) continue;
            names += (names.empty() ? "" : " ") + std::string(check.name);
            ++found;
        } catch (const std::exception& e) {
            crashes += std::string(check.name) + ": " + e.what() + "\n";
        }
    }
    return names;
}

}  // namespace

TEST_CASE("every mutant is killed", "[mutation]") {
    const int wanted = std::getenv("KOKSMA_ALL_KILLERS") != nullptr ? 1000 : 3;
    int killed = 0, all = 0;
    std::printf("%-16s %-32s rejected by\n", "family", "mutant");
    for (const Family& family : all_families()) {
        std::string crashes;
        const std::string alarms = rejected_by(subject(family, "healthy", family.healthy), crashes, 1000);
        std::printf("%-16s %-32s %s\n", family.name.c_str(), "(healthy)", alarms.empty() ? "-" : alarms.c_str());
        INFO("the healthy sampler of the family " << family.name << " is rejected by: " << alarms);
        CHECK(alarms.empty());
        for (const Mutant& mutant : family.mutants) {
            const std::string names = rejected_by(subject(family, mutant.name, mutant.value), crashes, wanted);
            std::printf("%-16s %-32s %s\n", family.name.c_str(), mutant.name.c_str(), names.c_str());
            INFO("survives: " << family.name << "/" << mutant.name << " (" << mutant.fault << ")");
            CHECK_FALSE(names.empty());
            ++all;
            killed += !names.empty();
        }
        INFO("checks that threw, family " << family.name << ":\n" << crashes);
        CHECK(crashes.empty());
    }
    std::printf("killed %d of %d\n", killed, all);
    std::fflush(stdout);
    CHECK(killed == all);
    CHECK(all >= 45);
}
