// Every sampler that this program was linked with, in every combination of its enumerated options, against every check.

#include <koksma/conformance/checks.h>

#include "../samplers/matrix_file.h"

#include <koksma_catch.h>

using namespace koksma;
using namespace koksma::conformance;

namespace {

/// All subjects, made once.
const std::vector<Subject>& all_subjects() {
    static const std::vector<Subject> all = [] {
        Registry registry;
        register_samplers(registry);
        return subjects(registry);
    }();
    return all;
}

void run(std::string_view wanted) {
    for (const Check& check : all_checks()) {
        if (check.name != wanted) continue;
        REQUIRE_FALSE(all_subjects().empty());
        for (const Subject& subject : all_subjects()) {
            const Finding finding = check.run(subject);
            INFO(subject.name() << ": " << check.name << " (" << check.says << "): " << finding.numbers);
            CHECK(finding.passed);
        }
        return;
    }
    FAIL("no check is named " << wanted);
}

}  // namespace

TEST_CASE("all values lie in the unit interval", "[conformance]") { run("range"); }
TEST_CASE("values do not depend on the order or the batch they are drawn in", "[conformance]") { run("order"); }
TEST_CASE("values of a sequence do not depend on the plan's spp", "[conformance]") { run("prefix"); }
TEST_CASE("limits are refused or come from the tail", "[conformance]") { run("limits"); }
TEST_CASE("no dimension repeats another one", "[conformance]") { run("dimensions"); }
TEST_CASE("a dimension has one value, drawn alone or in a pair", "[conformance]") { run("access"); }
TEST_CASE("unscrambled points are the published ones", "[conformance]") { run("points"); }
TEST_CASE("promised strata hold one value each", "[conformance]") { run("strata"); }
TEST_CASE("square sets have one point in each cell", "[conformance]") { run("cells"); }
TEST_CASE("digital nets have one point in each elementary interval", "[conformance]") { run("net"); }
TEST_CASE("projections of the Sobol' sequence have their quality parameters", "[conformance]") { run("projections"); }
TEST_CASE("no point occurs twice", "[conformance]") { run("repeats"); }
TEST_CASE("shared pixels and unrandomized seeds are equal", "[conformance]") { run("sharing"); }
TEST_CASE("no stream equals another one under a shift", "[conformance]") { run("shifts"); }
TEST_CASE("no two seeds, pixels or dimensions share a key", "[conformance]") { run("keys"); }
TEST_CASE("one sample is uniform over seeds", "[conformance]") { run("uniform"); }
TEST_CASE("two dimensions of one sample are independent over seeds", "[conformance]") { run("pairs"); }
TEST_CASE("differences of two samples are independent between sets of dimensions", "[conformance]") { run("differences"); }
TEST_CASE("neighbouring pixels are independent", "[conformance]") { run("pixels"); }
TEST_CASE("consecutive seeds are independent", "[conformance]") { run("seeds"); }
TEST_CASE("errors of pixels and seeds do not correlate", "[conformance]") { run("errors"); }
TEST_CASE("estimates of simple products are unbiased", "[conformance]") { run("bias"); }
TEST_CASE("products of dimensions vary no more than independent ones", "[conformance]") { run("products"); }
TEST_CASE("Owen scrambling is nested", "[conformance]") { run("nesting"); }
TEST_CASE("samples of random are uncorrelated at small lags", "[conformance]") { run("lags"); }
TEST_CASE("very many samples fill the interval evenly", "[conformance]") { run("histogram"); }

/// Not among the subjects of `check all`: these need a file.
TEST_CASE("matrices from files in odd bases keep every promise", "[conformance]") {
    Registry registry;
    register_samplers(registry);
    for (const auto& [base, rows, columns] : {std::tuple{3u, 17u, 14u}, {5u, 11u, 10u}}) {
        const test::File file(test::faure_text(base, base, rows, columns));
        for (const Subject& subject : subjects(registry, "matrices:file=" + file.path + ",pad=2,randomize=owen"))
            for (const Check& check : all_checks()) {
                const Finding finding = check.run(subject);
                INFO(subject.name() << ": " << check.name << " (" << check.says << "): " << finding.numbers);
                CHECK(finding.passed);
            }
    }
}
