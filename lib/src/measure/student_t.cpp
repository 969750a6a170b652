#include <koksma/measure/statistics.h>
#include <koksma/sampling/error.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>

namespace koksma {
namespace {

/// Beyond this many degrees the normal approximation is better than what the beta function's logarithms leave.
constexpr double kLargeDof = 1e5;

void check_dof(double dof) {
    if (!(dof > 0)) throw Error("degrees of freedom: found " + std::to_string(dof) + ", expected > 0");
}

/// The continued fraction of I_x(a, b), which converges quickly for x < (a + 1) / (a + b + 2). DLMF 8.17.22.
double beta_fraction(double x, double a, double b) {
    constexpr double kTiny = 1e-300;  // Lentz's guard against a zero denominator
    const auto guarded = [](double v) { return std::abs(v) < kTiny ? kTiny : v; };
    double c = 1, d = 1 / guarded(1 - (a + b) * x / (a + 1)), h = d;
    for (int m = 1; m < 10000; ++m) {
        const double even = m * (b - m) * x / ((a + 2 * m - 1) * (a + 2 * m));
        d = 1 / guarded(1 + even * d);
        c = guarded(1 + even / c);
        h *= d * c;
        const double odd = -(a + m) * (a + b + m) * x / ((a + 2 * m) * (a + 2 * m + 1));
        d = 1 / guarded(1 + odd * d);
        c = guarded(1 + odd / c);
        h *= d * c;
        if (std::abs(d * c - 1) < 1e-16) break;
    }
    return h;
}

/// x^a y^b / (a B(a, b)) times the fraction, with y = 1 - x given apart so that neither loses digits.
double beta_series(double x, double y, double a, double b) {
    const double log_beta = std::lgamma(a) + std::lgamma(b) - std::lgamma(a + b);
    return std::exp(a * std::log(x) + b * std::log(y) - log_beta) * beta_fraction(x, a, b) / a;
}

double incomplete_beta(double x, double y, double a, double b) {
    if (x <= 0) return 0;
    if (y <= 0) return 1;
    return x < (a + 1) / (a + b + 2) ? beta_series(x, y, a, b) : 1 - beta_series(y, x, b, a);
}

double normal_tail(double z) { return 0.5 * std::erfc(z / std::numbers::sqrt2); }

/// P(T > t) for t >= 0.
double t_tail(double t, double dof) {
    if (std::isinf(t)) return 0;
    if (std::isinf(dof)) return normal_tail(t);
    if (dof > kLargeDof) return normal_tail(t * (1 - 1 / (4 * dof)) / std::sqrt(1 + t * t / (2 * dof)));  // A&S 26.7.8
    // x = dof / (dof + t^2), from r = t / sqrt(dof) so that a huge t does not overflow.
    const double r = t / std::sqrt(dof);
    const double x = r < 1 ? 1 / (1 + r * r) : (1 / r) * (1 / r) / (1 + (1 / r) * (1 / r));
    const double y = r < 1 ? r * r / (1 + r * r) : 1 / (1 + (1 / r) * (1 / r));
    return 0.5 * incomplete_beta(x, y, dof / 2, 0.5);
}

/// Only a derivative for Newton's method: the normal one does beyond kLargeDof.
double t_density(double t, double dof) {
    if (dof > kLargeDof) return std::exp(-0.5 * t * t) / std::sqrt(2 * std::numbers::pi);
    const double log_scale = std::lgamma(0.5 * (dof + 1)) - std::lgamma(0.5 * dof) - 0.5 * std::log(dof * std::numbers::pi);
    return std::exp(log_scale - 0.5 * (dof + 1) * std::log1p(t / dof * t));
}

}  // namespace

double incomplete_beta(double x, double a, double b) {
    if (!(x >= 0 && x <= 1 && a > 0 && b > 0))
        throw Error("incomplete beta: found x = " + std::to_string(x) + ", a = " + std::to_string(a) + ", b = " + std::to_string(b) +
                    "; expected x in [0, 1], a > 0, b > 0");
    return incomplete_beta(x, 1 - x, a, b);
}

double student_t_cdf(double t, double dof) {
    check_dof(dof);
    if (std::isnan(t)) return t;
    return t < 0 ? t_tail(-t, dof) : 1 - t_tail(t, dof);
}

double student_t_quantile(double p, double dof) {
    check_dof(dof);
    if (!(p > 0 && p < 1)) throw Error("quantile: found p = " + std::to_string(p) + ", expected inside (0, 1)");
    if (p == 0.5) return 0;
    const double tail = std::min(p, 1 - p);
    double lo = 0, hi = 1;
    while (t_tail(hi, dof) > tail && hi < std::numeric_limits<double>::max() / 4) {
        lo = hi;
        hi *= 2;
    }
    // Newton's method inside a bracket: halve the bracket whenever a step would leave it.
    double t = 0.5 * (lo + hi);
    for (int i = 0; i < 200; ++i) {
        const double excess = t_tail(t, dof) - tail;
        (excess > 0 ? lo : hi) = t;
        double next = t + excess / t_density(t, dof);
        if (!(next > lo && next < hi)) next = 0.5 * (lo + hi);
        const double step = next - t;
        t = next;
        if (std::abs(step) <= 1e-14 * t) break;
    }
    return p < 0.5 ? -t : t;
}

double student_t_factor(double confidence, double dof) {
    if (!(confidence > 0 && confidence < 1))
        throw Error("confidence: found " + std::to_string(confidence) + ", expected inside (0, 1), as 0.95");
    return student_t_quantile(0.5 * (1 + confidence), dof);
}

double f_tail(double f, double dof1, double dof2) {
    check_dof(dof1);
    check_dof(dof2);
    if (std::isnan(f)) return f;
    if (f <= 0) return 1;
    if (std::isinf(f)) return 0;
    return incomplete_beta(dof2 / (dof2 + dof1 * f), dof1 * f / (dof2 + dof1 * f), dof2 / 2, dof1 / 2);
}

}  // namespace koksma
