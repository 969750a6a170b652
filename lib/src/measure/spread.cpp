#include <koksma/measure/spread.h>
#include <koksma/sampling/error.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>

namespace koksma {

namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

/// The f with P(F > f) = tail, by halving; ten digits are plenty.
double f_quantile_above(double tail, double dof1, double dof2) {
    double lo = 0, hi = 1;
    while (f_tail(hi, dof1, dof2) > tail) hi *= 2;
    for (int i = 0; i < 80; ++i) {
        const double middle = 0.5 * (lo + hi);
        (f_tail(middle, dof1, dof2) > tail ? lo : hi) = middle;
    }
    return 0.5 * (lo + hi);
}

/// Chi-squared over its degrees: F against a variance that is known (1e5 degrees are as good).
double chi2_over_dof_above(double tail, double dof) { return f_quantile_above(tail, dof, 1e5); }

}  // namespace

Spread spread(std::span<const double> first, const std::vector<std::vector<double>>& groups, double confidence) {
    const double tail = 0.5 * (1 - confidence);
    const Moments of_first = moments(first);
    std::vector<double> logs;
    double noise = 0, dof_within = 0;
    bool positive = of_first.mean > 0, enough = groups.size() >= 2 && of_first.n >= 2;
    for (const std::vector<double>& g : groups) {
        const Moments m = moments(g);
        enough = enough && m.n >= 2;
        positive = positive && m.mean > 0;
        logs.push_back(0.5 * std::log(m.mean));
        noise += 0.25 * m.log_mean_variance() / static_cast<double>(groups.size());
        dof_within += m.n - 1;
    }
    if (!enough) throw Error("a spread needs two groups of two replicates or more; there are " + std::to_string(groups.size()) + " groups");
    (void)student_t_factor(confidence, 1);  // a wrong confidence is an error for every input
    if (!positive) return {kNaN, kNaN, kNaN, {kNaN, kNaN, kNaN, kNaN, 0}, kNaN, {kNaN, kNaN, kNaN, kNaN, 0}};

    const Moments of_logs = moments(logs);
    const double count = of_logs.n, dof = count - 1;
    Spread s;
    s.rmse = std::exp(of_logs.mean);
    s.lowest = std::exp(*std::min_element(logs.begin(), logs.end()));
    s.highest = std::exp(*std::max_element(logs.begin(), logs.end()));
    const auto root = [](double variance) { return std::sqrt(std::max(0.0, variance)); };
    s.between.n = of_logs.n;
    s.between.value = root(of_logs.variance - noise);
    s.between.standard_error = kNaN;
    s.between.lo = root((of_logs.variance - noise * f_quantile_above(tail, dof, dof_within)) / chi2_over_dof_above(tail, dof));
    s.between.hi = root((of_logs.variance - noise * f_quantile_above(1 - tail, dof, dof_within)) / chi2_over_dof_above(1 - tail, dof));
    s.p_equal = noise > 0 ? f_tail(of_logs.variance / noise, dof, dof_within) : kNaN;

    const std::array variances = {0.25 * of_first.log_mean_variance(), of_logs.variance / count};
    const std::array dofs = {static_cast<double>(of_first.n - 1), dof};
    const double log_ratio = 0.5 * std::log(of_first.mean) - of_logs.mean, error = std::sqrt(variances[0] + variances[1]);
    const double half = student_t_factor(confidence, welch_satterthwaite(variances, dofs)) * error;
    s.first = {std::exp(log_ratio), std::exp(log_ratio - half), std::exp(log_ratio + half), std::exp(log_ratio) * error, of_first.n};
    return s;
}

}  // namespace koksma
