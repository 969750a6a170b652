#include <koksma/measure/statistics.h>
#include <koksma/sampling/error.h>

#include <cmath>
#include <cstddef>
#include <limits>

namespace koksma {
namespace {
constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
}

Moments moments(std::span<const double> replicates) noexcept {
    const auto n = static_cast<double>(replicates.size());
    Moments m{kNaN, kNaN, static_cast<int>(replicates.size())};
    if (m.n == 0) return m;
    double sum = 0;
    for (const double v : replicates) sum += v;
    m.mean = sum / n;
    if (m.n < 2) return m;
    double square = 0;
    for (const double v : replicates) square += (v - m.mean) * (v - m.mean);
    m.variance = square / (n - 1);
    return m;
}

double welch_satterthwaite(std::span<const double> terms, std::span<const double> dofs) noexcept {
    double sum = 0, denominator = 0;
    for (std::size_t i = 0; i < terms.size(); ++i) {
        sum += terms[i];
        denominator += terms[i] * terms[i] / (dofs[i] + 2);
    }
    return denominator > 0 ? sum * sum / denominator - 2 : std::numeric_limits<double>::infinity();
}

Estimate mean_estimate(std::span<const double> replicates, double confidence) {
    const Moments m = moments(replicates);
    // The factor is asked for even if it is not used: a wrong confidence is an error for every n.
    const double factor = student_t_factor(confidence, m.n < 2 ? 1 : m.n - 1);
    Estimate e{m.mean, kNaN, kNaN, kNaN, m.n};
    if (m.n < 2) return e;
    e.standard_error = std::sqrt(m.variance / m.n);
    e.lo = m.mean - factor * e.standard_error;
    e.hi = m.mean + factor * e.standard_error;
    return e;
}

}  // namespace koksma
