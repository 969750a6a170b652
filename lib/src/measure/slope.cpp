#include "log_means.h"

#include <koksma/measure/slope.h>
#include <koksma/sampling/error.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <string>

namespace koksma {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

/// The points that have a logarithm.
struct Usable {
    std::vector<double> x;  ///< log spp
    std::vector<double> weight;
    std::vector<LogMean> terms;
    double relative_variance = kNaN;  ///< of one replicate, pooled over points with their degrees of freedom
    double dof = 0;                   ///< of that
};

Usable usable_points(std::span<const RatePoint> points, SlopeFit& fit) {
    Usable u;
    double sum = 0;
    fit.from = fit.to = kNaN;
    for (const RatePoint& p : points) {
        if (!(std::isfinite(p.spp) && p.spp > 0)) throw Error("slope: found a point at " + std::to_string(p.spp) + ", expected > 0");
        const Moments m = moments(p.errors);
        if (!(m.mean > 0 && std::isfinite(m.mean))) {
            ++fit.skipped;
            continue;
        }
        u.x.push_back(std::log(p.spp));
        u.weight.push_back(m.n);  // times the pooled relative variance, which is the same for all
        u.terms.push_back(log_mean(p.errors, m));
        if (m.n > 1) {
            u.dof += m.n - 1;
            sum += (m.n - 1) * m.variance / (m.mean * m.mean);
        }
        fit.from = std::fmin(fit.from, p.spp);
        fit.to = std::fmax(fit.to, p.spp);
        ++fit.points;
    }
    if (u.dof > 0) u.relative_variance = sum / u.dof;
    for (std::size_t i = 0; i < u.terms.size(); ++i)
        if (u.terms[i].dof < 1 && u.dof > 0) {  // a single replicate borrows the spread of the others
            u.terms[i].variance = u.relative_variance;
            u.terms[i].dof = u.dof;
        }
    return u;
}

/// p of the hypothesis that what is left of the points about the line is the noise of their replicates.
double straight_line_p(const Usable& u, const SlopeFit& fit) {
    if (fit.points < 3 || !(u.relative_variance > 0)) return kNaN;
    double rest = 0;
    for (std::size_t i = 0; i < u.x.size(); ++i) {
        const double r = 0.5 * u.terms[i].value - (fit.intercept + fit.value * u.x[i]);
        rest += u.weight[i] * r * r;
    }
    const double dof = fit.points - 2;
    return f_tail(rest / dof / (0.25 * u.relative_variance), dof, u.dof);
}

}  // namespace

double SlopeFit::rmse_at(double spp) const noexcept { return std::exp(intercept + value * std::log(spp)); }

SlopeFit fit_slope(std::span<const RatePoint> points, double confidence) {
    SlopeFit fit;
    const Usable u = usable_points(points, fit);
    double weights = 0, x_mean = 0, y_mean = 0, xx = 0;
    for (std::size_t i = 0; i < u.x.size(); ++i) {
        weights += u.weight[i];
        x_mean += u.weight[i] * u.x[i];
        y_mean += u.weight[i] * 0.5 * u.terms[i].value;
    }
    if (weights > 0) {
        x_mean /= weights;
        y_mean /= weights;
    }
    for (std::size_t i = 0; i < u.x.size(); ++i) xx += u.weight[i] * (u.x[i] - x_mean) * (u.x[i] - x_mean);

    std::vector<double> c;  // slope = sum c_i log(mean MSE_i); the 0.5 makes an RMSE of it
    if (fit.points > 1 && fit.to > fit.from)
        for (std::size_t i = 0; i < u.x.size(); ++i) c.push_back(0.5 * u.weight[i] * (u.x[i] - x_mean) / xx);
    const LogCombination log = combine(c, std::span(u.terms).first(c.size()), confidence);
    if (c.empty()) {
        fit.value = fit.lo = fit.hi = fit.intercept = fit.standard_error = fit.straight_p = kNaN;
        return fit;
    }
    fit.value = log.value;
    fit.lo = log.lo;
    fit.hi = log.hi;
    fit.standard_error = log.standard_error;
    fit.dof = log.dof;
    fit.intercept = y_mean - fit.value * x_mean;
    fit.straight_p = straight_line_p(u, fit);
    return fit;
}

SlopeFit fit_prefix_slope(std::span<const double> spp, const std::vector<std::vector<double>>& errors, double confidence) {
    for (const std::vector<double>& e : errors)
        if (e.size() != spp.size())
            throw Error("slope of prefixes: found a render of " + std::to_string(e.size()) + " prefixes, expected " +
                        std::to_string(spp.size()));
    const auto without = [&](std::size_t left_out) {
        std::vector<RatePoint> points;
        for (std::size_t i = 0; i < spp.size(); ++i) {
            points.push_back({spp[i], {}});
            for (std::size_t k = 0; k < errors.size(); ++k)
                if (k != left_out) points.back().errors.push_back(errors[k][i]);
        }
        return fit_slope(points, confidence);
    };
    SlopeFit fit = without(errors.size());
    fit.straight_p = kNaN;
    if (fit.skipped > 0) fit.value = kNaN;
    const double n = static_cast<double>(errors.size());
    double mean = 0, square = 0;
    std::vector<double> left;
    for (std::size_t k = 0; k < errors.size() && errors.size() > 1; ++k) left.push_back(without(k).value);
    for (const double v : left) mean += v / n;
    for (const double v : left) square += (v - mean) * (v - mean);
    fit.dof = n - 1;
    fit.standard_error = errors.size() > 1 && fit.skipped == 0 ? std::sqrt((n - 1) / n * square) : kNaN;
    const double half = errors.size() > 1 ? student_t_factor(confidence, n - 1) * fit.standard_error : kNaN;
    fit.lo = fit.value - half;
    fit.hi = fit.value + half;
    return fit;
}

}  // namespace koksma
