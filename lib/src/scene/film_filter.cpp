#include <koksma/sampling/error.h>
#include <koksma/scene/film_filter.h>

#include <numbers>
#include <string>

namespace koksma {

namespace {

double reach(const ReconstructionFilter& f) noexcept { return f.kind == ReconstructionFilter::Kind::gaussian ? 4.0 * f.stddev : f.radius; }

/// The part of a filter that is nearer to the centre than x, in [0, radius].
class Inner {
public:
    explicit Inner(const ReconstructionFilter& f) : filter_(f), radius_(reach(f)), whole_(integral(radius_)) {}
    [[nodiscard]] double operator()(double x) const noexcept { return x < radius_ ? integral(x) / whole_ : 1.0; }

private:
    [[nodiscard]] double integral(double x) const noexcept {
        if (filter_.kind == ReconstructionFilter::Kind::box) return x;
        if (filter_.kind == ReconstructionFilter::Kind::tent) return x - 0.5 * x * x / radius_;
        // exp(-x^2 / 2 s^2) less its value at the radius, so that it ends without a step, as in Mitsuba.
        const double s = filter_.stddev;
        return s * std::sqrt(0.5 * std::numbers::pi) * std::erf(x / (s * std::numbers::sqrt2)) - x * std::exp(-8.0);
    }
    const ReconstructionFilter& filter_;
    double radius_, whole_;
};

}  // namespace

CompiledFilter compile_filter(const ReconstructionFilter& filter) {
    CompiledFilter out;
    const double radius = reach(filter);
    if (!(radius > 0.0 && radius <= kLargestFilterRadius))
        throw Error("a reconstruction filter reaches " + std::to_string(radius) + " pixels; it must be in (0, 32]");
    if (filter.is_pixel()) return out;
    const Inner inner(filter);
    constexpr int kCells = 512;
    out.distance.resize(kCells + 1);
    for (int i = 0; i <= kCells; ++i) {
        const double s = static_cast<double>(i) / kCells, wanted = 1.0 - s * s;
        double low = 0.0, high = radius;
        for (int step = 0; step < 60; ++step) {
            const double middle = 0.5 * (low + high);
            (inner(middle) < wanted ? low : high) = middle;
        }
        out.distance[static_cast<std::size_t>(i)] = static_cast<float>(0.5 * (low + high));
    }
    if (!filter.beyond_film)
        for (double border = 0.5; border < radius; border += 1.0) out.beyond.push_back(static_cast<float>(0.5 * (1.0 - inner(border))));
    return out;
}

}  // namespace koksma
