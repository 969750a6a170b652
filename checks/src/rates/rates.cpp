#include <koksma/rates/rates.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace koksma::convergence {

namespace {

/// Running sums of all integrands over the points of one replicate.
class Estimates {
public:
    Estimates(std::span<const Integrand> integrands, const DimensionLayout& layout)
        : integrands_(integrands), layout_(layout), sums_(integrands.size(), 0.0) {}

    /// Adds the samples [first, last) of a pixel.
    void add(const SampleSource& source, Pixel pixel, std::uint64_t first, std::uint64_t last) {
        constexpr std::size_t kBatch = 1024;
        const std::size_t dimensions = layout_.dimensions();
        ids_.resize(kBatch);
        values_.resize(kBatch * dimensions);
        std::vector<double> u(dimensions);
        while (first < last) {
            const auto n = static_cast<std::size_t>(std::min<std::uint64_t>(kBatch, last - first));
            for (std::size_t i = 0; i < n; ++i) ids_[i] = {pixel, first + i};
            source.fill(std::span(ids_).first(n), layout_.slots(), values_.data(), kBatch);
            for (std::size_t i = 0; i < n; ++i) {
                for (std::size_t d = 0; d < dimensions; ++d) u[d] = static_cast<double>(values_[d * kBatch + i]);
                for (std::size_t k = 0; k < sums_.size(); ++k) sums_[k] += integrands_[k].value(u.data());
            }
            first += n;
        }
    }
    void reset() { std::fill(sums_.begin(), sums_.end(), 0.0); }
    [[nodiscard]] double error(std::size_t k, std::uint64_t count) const {
        return sums_[k] / static_cast<double>(count) - integrands_[k].integral;
    }

private:
    std::span<const Integrand> integrands_;
    const DimensionLayout& layout_;
    std::vector<double> sums_;
    std::vector<SampleId> ids_{};
    std::vector<float> values_{};
};

DimensionLayout layout_for(std::span<const Integrand> integrands) {
    int largest = 1;
    for (const Integrand& f : integrands) largest = std::max(largest, int{f.dimensions});
    const std::vector<std::uint8_t> arities =
        largest == 1 ? std::vector<std::uint8_t>{1} : std::vector<std::uint8_t>(static_cast<std::size_t>((largest + 1) / 2), 2);
    return plain_layout(arities);
}

ErrorAtCount summarise(std::uint64_t count, std::span<const double> errors) {
    const auto n = static_cast<double>(errors.size());
    double mean = 0, square = 0, fourth = 0;
    for (const double e : errors) {
        mean += e / n;
        square += e * e / n;
        fourth += e * e * e * e / n;
    }
    const double standard_error = std::sqrt(std::max(0.0, square - mean * mean) / (n - 1));
    ErrorAtCount result{.count = count, .rmse = std::sqrt(square)};
    if (square > 0) result.kurtosis = fourth / (square * square);
    if (standard_error > 1e-12) result.bias_z = mean / standard_error;
    return result;
}

/// The standard error of the slope: replicates are left out one by one, each at all counts, since in a sequence they are correlated.
/// @param errors  those of one integrand, [count][replicate]
double jackknife(std::span<const ErrorAtCount> all, std::span<const double> errors) {
    const std::size_t counts = all.size(), replicates = errors.size() / counts;
    std::vector<ErrorAtCount> rest(all.begin(), all.end());
    double sum = 0, square = 0;
    for (std::size_t r = 0; r < replicates; ++r) {
        for (std::size_t c = 0; c < counts; ++c) {
            const auto n = static_cast<double>(replicates);
            const double e = errors[c * replicates + r];
            rest[c].rmse = std::sqrt(std::max(0.0, (all[c].rmse * all[c].rmse * n - e * e) / (n - 1)));
        }
        const double slope = fit_slope(rest);
        sum += slope;
        square += slope * slope;
    }
    const auto n = static_cast<double>(replicates);
    return std::sqrt(std::max(0.0, (square - sum * sum / n) * (n - 1) / n));
}

}  // namespace

const ErrorAtCount& Rates::at(std::uint64_t count) const {
    for (const ErrorAtCount& e : errors)
        if (e.count == count) return e;
    throw std::out_of_range("no errors were measured at N = " + std::to_string(count));
}

std::vector<std::uint64_t> powers_of_two(int first, int last, int step) {
    std::vector<std::uint64_t> counts;
    for (int k = first; k <= last; k += step) counts.push_back(std::uint64_t{1} << k);
    return counts;
}

std::vector<std::uint64_t> counts_for(const SamplerInfo& info, std::uint64_t most) {
    using Rule = GoodCounts::Rule;
    const std::uint64_t base = info.good_counts.rule == Rule::power ? info.good_counts.base : info.good_counts.rule == Rule::square ? 4 : 2;
    std::vector<std::uint64_t> counts;
    for (std::uint64_t n = base; base > 1 && n <= std::min(most, info.max_samples); n *= base)
        if (n >= 64) counts.push_back(n);
    return counts;
}

double fit_slope(std::span<const ErrorAtCount> errors) {
    double x_mean = 0, y_mean = 0, xy = 0, xx = 0;
    for (const ErrorAtCount& e : errors) {
        x_mean += std::log2(static_cast<double>(e.count)) / static_cast<double>(errors.size());
        y_mean += std::log2(e.rmse) / static_cast<double>(errors.size());
    }
    for (const ErrorAtCount& e : errors) {
        const double x = std::log2(static_cast<double>(e.count)) - x_mean;
        xy += x * (std::log2(e.rmse) - y_mean);
        xx += x * x;
    }
    return xy / xx;
}

std::vector<Rates> run_rates(const SamplerFactory& factory, std::span<const Integrand> integrands, const RateSettings& settings) {
    SamplingPlan plan;
    plan.film_width = settings.pixel.x + 1;
    plan.film_height = settings.pixel.y + 1;
    plan.layout = layout_for(integrands);
    const bool is_set = factory.info().kind == SamplerKind::set;
    const auto replicates = static_cast<std::size_t>(settings.replicates);
    // errors[(k * counts + c) * replicates + r]
    std::vector<double> errors(integrands.size() * settings.counts.size() * replicates);
    Estimates estimates(integrands, plan.layout);
    for (std::size_t r = 0; r < replicates; ++r) {
        plan.seed = settings.first_seed + r;
        plan.spp = settings.counts.back();
        std::unique_ptr<SampleSource> source = is_set ? nullptr : factory.bind(plan);
        std::uint64_t drawn = 0;
        estimates.reset();
        for (std::size_t c = 0; c < settings.counts.size(); ++c) {
            const std::uint64_t count = settings.counts[c];
            if (is_set) {
                plan.spp = count;
                source = factory.bind(plan);
                estimates.reset();
                drawn = 0;
            }
            estimates.add(*source, settings.pixel, drawn, count);
            drawn = count;
            for (std::size_t k = 0; k < integrands.size(); ++k)
                errors[(k * settings.counts.size() + c) * replicates + r] = estimates.error(k, count);
        }
    }
    std::vector<Rates> all;
    for (std::size_t k = 0; k < integrands.size(); ++k) {
        Rates rates{.sampler = factory.name(), .integrand = integrands[k]};
        for (std::size_t c = 0; c < settings.counts.size(); ++c)
            rates.errors.push_back(summarise(
                settings.counts[c], std::span(errors).subspan((k * settings.counts.size() + c) * replicates, replicates)));
        rates.slope = fit_slope(rates.errors);
        rates.slope_error = jackknife(rates.errors, std::span(errors).subspan(k * settings.counts.size() * replicates, settings.counts.size() * replicates));
        all.push_back(std::move(rates));
    }
    return all;
}

Rates run_rates(const SamplerFactory& factory, const Integrand& integrand, const RateSettings& settings) {
    return run_rates(factory, std::span(&integrand, 1), settings).front();
}

}  // namespace koksma::convergence
