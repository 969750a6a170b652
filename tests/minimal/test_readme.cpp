// The sampler that the README shows: cut out of the page at configure time, held to every check that Koksma's own are held to.

#include <padded02.h>

#include <koksma/conformance/checks.h>

#include <koksma_catch.h>

TEST_CASE("the README's sampler passes every check", "[conformance]") {
    using namespace koksma::conformance;
    koksma::Registry registry;
    registry.add<Padded02>();
    int applied = 0;
    for (const Subject& subject : subjects(registry))
        for (const Check& check : all_checks()) {
            const Finding finding = check.run(subject);
            INFO(subject.name() << ": " << check.name << " (" << check.says << "): " << finding.numbers);
            CHECK(finding.passed);
            applied += finding.applies;
        }
    CHECK(applied >= 18);
}
