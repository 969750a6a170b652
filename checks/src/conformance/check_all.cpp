#include <koksma/conformance/checks.h>

namespace koksma::conformance {

const std::vector<Check>& all_checks() {
    static const std::vector<Check> all = [] {
        std::vector<Check> checks;
        for (const std::span<const Check> part : {exact_checks(), net_checks(), stream_checks(), seed_checks(), estimate_checks()})
            checks.insert(checks.end(), part.begin(), part.end());
        return checks;
    }();
    return all;
}

}  // namespace koksma::conformance
