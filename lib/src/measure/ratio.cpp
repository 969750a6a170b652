#include "log_means.h"

#include <koksma/measure/ratio.h>

#include <algorithm>
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

Comparison compare_errors(std::span<const double> a, std::span<const double> b, double confidence) {
    constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
    Comparison c{gain(a, b, confidence), kNaN, kNaN};
    if (!(c.gain.lo <= c.gain.hi)) return c;
    // The confidence whose interval just reaches 1: ends move outwards with it, so halving finds it.
    const auto excludes = [&](double tail) {
        const Gain g = gain(a, b, 1 - tail);
        return g.distinguishable();
    };
    constexpr double kLeast = 1e-12;
    if (excludes(kLeast)) {
        c.p = kLeast;
        return c;
    }
    double lo = kLeast, hi = 1 - 1e-9;
    if (!excludes(hi)) {
        c.p = 1;
        return c;
    }
    for (int i = 0; i < 60; ++i) {
        const double middle = std::sqrt(lo * hi);
        (excludes(middle) ? hi : lo) = middle;
    }
    c.p = hi;
    return c;
}

void holm(std::vector<Comparison>& family) {
    std::vector<Comparison*> known;
    for (Comparison& c : family) {
        c.p_holm = c.p;
        if (c.p >= 0) known.push_back(&c);
    }
    std::sort(known.begin(), known.end(), [](const Comparison* x, const Comparison* y) { return x->p < y->p; });
    double least = 0;
    for (std::size_t i = 0; i < known.size(); ++i) {
        least = std::max(least, std::min(1.0, known[i]->p * static_cast<double>(known.size() - i)));
        known[i]->p_holm = least;
    }
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
