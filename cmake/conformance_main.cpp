// The main function of koksma_add_conformance(): every sampler of this program against every check.

#include <koksma/conformance/checks.h>

#include <cstdio>
#include <exception>

namespace {

int failures() {
    using namespace koksma::conformance;
    koksma::Registry registry;
    koksma::register_samplers(registry);
    int failed = 0;
    for (const Subject& subject : subjects(registry))
        for (const std::span<const Check> checks : {exact_checks(), net_checks(), stream_checks(), seed_checks(), estimate_checks()})
            for (const Check& check : checks) {
                const Finding finding = check.run(subject);
                if (!finding.applies) continue;
                failed += finding.passed ? 0 : 1;
                std::printf("%s  %s: %s: %s\n", finding.passed ? "ok    " : "FAILED", subject.name().c_str(), std::string(check.says).c_str(),
                            finding.numbers.c_str());
            }
    return failed;
}

}  // namespace

int main() {
    try {
        const int failed = failures();
        std::printf("%d checks failed\n", failed);
        return failed == 0 ? 0 : 1;
    } catch (const std::exception& e) {
        std::fprintf(stderr, "%s\n", e.what());
        return 1;
    }
}
