#pragma once
// The middle of a few measurements and how far they lie apart.

#include <algorithm>
#include <vector>

namespace koksma {

/// Median, with the lowest and the highest value.
struct Spread {
    double median = 0.0, lowest = 0.0, highest = 0.0;
};

[[nodiscard]] inline Spread spread_of(std::vector<double> values) {
    if (values.empty()) return {};
    std::sort(values.begin(), values.end());
    const std::size_t n = values.size();
    return {n % 2 == 1 ? values[n / 2] : 0.5 * (values[n / 2 - 1] + values[n / 2]), values.front(), values.back()};
}

}  // namespace koksma
