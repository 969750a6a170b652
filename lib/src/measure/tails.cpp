#include <koksma/measure/tails.h>

#include <algorithm>

namespace koksma {

bool heavy_tailed(const std::vector<std::vector<double>>& points) noexcept {
    for (const std::vector<double>& p : points) {
        if (p.size() < 3) continue;
        const double largest = *std::max_element(p.begin(), p.end());
        double sum = 0;
        for (const double v : p) sum += v;
        const double others = (sum - largest) / static_cast<double>(p.size() - 1);
        if (others > 0 && largest > kTailRatio * others) return true;
    }
    return false;
}

MeasuredCoverage heavy_tailed_coverage(int replicates) noexcept {
    constexpr MeasuredCoverage kMeasured[] = {{4, 0.937, 0.914, 0.870}, {8, 0.944, 0.928, 0.913}, {16, 0.950, 0.942, 0.926}};
    return kMeasured[replicates >= 16 ? 2 : (replicates >= 8 ? 1 : 0)];
}

}  // namespace koksma
