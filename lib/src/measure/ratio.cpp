#include "log_means.h"

#include <koksma/measure/ratio.h>

#include <array>
#include <cmath>
#include <limits>

namespace koksma {

Gain gain(std::span<const double> a, std::span<const double> b, double confidence) {
    constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
    const Moments ma = moments(a), mb = moments(b);
    if (!(ma.mean > 0 && mb.mean > 0)) {
        (void)student_t_factor(confidence, 1);  // a wrong confidence is an error for every input
        return {kNaN, kNaN, kNaN, 0, ma.mean <= 0 || mb.mean <= 0};
    }
    const std::array terms = {log_mean(b, mb), log_mean(a, ma)};
    const std::array c = {1.0, -1.0};
    const LogCombination log = combine(c, terms, confidence);
    return {mb.mean / ma.mean, std::exp(log.lo), std::exp(log.hi), log.dof, false};
}

Gain interpolated_gain(std::span<const double> a, std::span<const double> below, std::span<const double> above, double weight, double confidence) {
    constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
    const Moments ma = moments(a), first = moments(below), last = moments(above);
    if (!(ma.mean > 0 && first.mean > 0 && last.mean > 0)) {
        (void)student_t_factor(confidence, 1);
        return {kNaN, kNaN, kNaN, 0, ma.mean <= 0 || first.mean <= 0 || last.mean <= 0};
    }
    const std::array terms = {log_mean(below, first), log_mean(above, last), log_mean(a, ma)};
    const std::array c = {1.0 - weight, weight, -1.0};
    const LogCombination log = combine(c, terms, confidence);
    return {std::exp(log.value), std::exp(log.lo), std::exp(log.hi), log.dof, false};
}

}  // namespace koksma
