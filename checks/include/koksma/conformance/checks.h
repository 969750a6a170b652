#pragma once
// The checks, as functions: a sampler goes in, a finding comes out. The test cases print them; other programs may too.

#include <koksma/conformance/subject.h>

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace koksma::conformance {

/// What a check found. `numbers` says what was measured against which limit; of a failure it names the place.
struct Finding {
    bool applies = true;
    bool passed = true;
    std::string numbers{};
};

struct Check {
    std::string_view name;  ///< one word, stable: mutants and reports refer to it
    std::string_view says;  ///< what a passing sampler has, a sentence
    Finding (*run)(const Subject&);
};

/// Checks without chance of how values are drawn: range, purity, order, limits, repeats.
[[nodiscard]] std::span<const Check> exact_checks() noexcept;

/// Checks without chance of where values lie: published points, strata, cells, nets, projections.
[[nodiscard]] std::span<const Check> net_checks() noexcept;

/// Checks that no stream is a copy of another: shifts and keys.
[[nodiscard]] std::span<const Check> stream_checks() noexcept;

/// Checks of one or two values over 4096 seeds: uniform, independent between dimensions, pixels, seeds and digits.
/// Seeds are fixed, counted from the subject's first. Thresholds of these and the next are about six standard deviations; there are some ten thousand comparisons.
[[nodiscard]] std::span<const Check> seed_checks() noexcept;

/// Checks of estimates: bias, correlation, variance, and the histogram of very many samples.
[[nodiscard]] std::span<const Check> estimate_checks() noexcept;

/// All of the above, in this order.
[[nodiscard]] const std::vector<Check>& all_checks();

}  // namespace koksma::conformance
