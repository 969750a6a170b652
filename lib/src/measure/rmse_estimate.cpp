#include "log_means.h"

#include <koksma/measure/rmse_estimate.h>

#include <cmath>
#include <limits>

namespace koksma {

Estimate metric_estimate(std::span<const double> replicates, double confidence, double floor) {
    constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
    const Moments m = moments(replicates);
    if (!(m.mean > floor && m.mean > 0)) {
        (void)student_t_factor(confidence, 1);  // a wrong confidence is an error for every input
        return {kNaN, kNaN, kNaN, kNaN, m.n};
    }
    const LogMean term = log_mean(replicates, m);
    const double one = 1;
    const LogCombination log = combine({&one, 1}, {&term, 1}, confidence);
    return {m.mean, std::exp(log.lo), std::exp(log.hi), m.mean * log.standard_error, m.n};
}

RmseEstimate rmse_estimate(std::span<const double> mse_replicates, double confidence, double floor) {
    RmseEstimate r;
    r.mse = metric_estimate(mse_replicates, confidence, floor);
    r.mean_mse = moments(mse_replicates).mean;
    r.below_floor = r.mean_mse <= floor || r.mean_mse <= 0;
    const double root = std::sqrt(r.mse.value);
    // d sqrt(m) = dm / (2 sqrt(m)); the interval itself is carried over exactly.
    r.rmse = {root, std::sqrt(r.mse.lo), std::sqrt(r.mse.hi), r.mse.standard_error / (2 * root), r.mse.n};
    return r;
}

}  // namespace koksma
