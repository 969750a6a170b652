// The other side of the mutants: a healthy sampler is never rejected. Every check on every sampler from 20 fresh master seeds; each
// seed takes the next combination of a sampler's options. KOKSMA_ALL_COMBINATIONS=1: all of them at every seed (a matter of minutes).

#include <koksma/conformance/checks.h>
#include <koksma/sampling/bits.h>

#include <koksma_catch.h>

#include <cstdlib>

using namespace koksma;
using namespace koksma::conformance;

namespace {

void run(std::uint64_t first, std::uint64_t last) {
    Registry registry;
    register_samplers(registry);
    std::vector<std::vector<Subject>> samplers;
    for (const Subject& s : subjects(registry)) {
        if (samplers.empty() || samplers.back().front().info().name != s.info().name) samplers.emplace_back();
        samplers.back().push_back(s);
    }
    REQUIRE_FALSE(samplers.empty());
    for (std::uint64_t master = first; master < last; ++master)
        for (const std::vector<Subject>& combinations : samplers)
            for (std::size_t k = 0; k < combinations.size(); ++k) {
                if (std::getenv("KOKSMA_ALL_COMBINATIONS") == nullptr && k != master % combinations.size()) continue;
                Subject s = combinations[k];
                s.first_seed = mix64(master + 1);
                for (const Check& check : all_checks()) {
                    const Finding finding = check.run(s);
                    INFO("master seed " << master << " (first seed " << s.first_seed << "), " << s.name() << ": " << check.name << ": " << finding.numbers);
                    CHECK(finding.passed);
                }
            }
}

}  // namespace

TEST_CASE("healthy samplers pass from fresh master seeds 0 to 9", "[mutation]") { run(0, 10); }
TEST_CASE("healthy samplers pass from fresh master seeds 10 to 19", "[mutation]") { run(10, 20); }
