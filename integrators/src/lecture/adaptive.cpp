#include <koksma/integrators/lecture/adaptive.h>
#include <koksma/measure/metrics.h>
#include <koksma/measure/seeds.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

namespace koksma {

namespace {

double luminance(const float* rgb) noexcept {
    double sum = 0;
    for (int c = 0; c < 3; ++c) sum += kLuminance[c] * static_cast<double>(rgb[c]);
    return sum;
}

/// Independent renders of the pilot, and how far they lie apart in each pixel.
struct Pilot {
    std::vector<std::vector<float>> images;
    std::uint64_t invalid = 0;

    /// Standard deviation between scrambles, of luminance, the variance averaged over the pixel and its neighbours: single pixels know too
    /// little.
    [[nodiscard]] std::vector<double> noise(PixelRect rect) const {
        const std::size_t pixels = static_cast<std::size_t>(rect.area());
        std::vector<double> variance(pixels), out(pixels);
        for (std::size_t p = 0; p < pixels; ++p) {
            double sum = 0, squares = 0;
            for (const std::vector<float>& image : images) {
                const double y = luminance(&image[3 * p]) - luminance(&images.front()[3 * p]);
                sum += y;
                squares += y * y;
            }
            const auto n = static_cast<double>(images.size());
            variance[p] = std::max(0.0, (squares - sum * sum / n) / (n - 1.0));
        }
        for (std::int32_t y = 0; y < rect.height; ++y)
            for (std::int32_t x = 0; x < rect.width; ++x) {
                double sum = 0;
                int n = 0;
                for (std::int32_t v = std::max(0, y - 1); v <= std::min(rect.height - 1, y + 1); ++v)
                    for (std::int32_t u = std::max(0, x - 1); u <= std::min(rect.width - 1, x + 1); ++u, ++n)
                        sum += variance[static_cast<std::size_t>(v * rect.width + u)];
                out[static_cast<std::size_t>(y * rect.width + x)] = std::sqrt(sum / n);
            }
        return out;
    }
};

/// The sampler's good counts; powers of two where every count is good.
std::vector<std::uint64_t> allowed_counts(const SamplerInfo& info, const AdaptiveSettings& s) {
    const bool any = info.good_counts.rule == GoodCounts::Rule::any;
    std::vector<std::uint64_t> out;
    for (std::uint64_t n = s.least_spp; n <= s.most_spp; ++n)
        if (any ? (n & (n - 1)) == 0 : info.good_counts.contains(n)) out.push_back(n);
    return out;
}

}  // namespace

std::vector<std::uint64_t> allocate(const std::vector<double>& noise, const std::vector<std::uint64_t>& allowed, double average) {
    const auto counts_at = [&](double samples_per_noise) {
        std::vector<std::uint64_t> counts;
        counts.reserve(noise.size());
        for (const double sigma : noise) {
            const double wanted = samples_per_noise * sigma;
            std::size_t k = 0;  // the nearest by ratio
            while (k + 1 < allowed.size() && wanted * wanted > static_cast<double>(allowed[k]) * static_cast<double>(allowed[k + 1])) ++k;
            counts.push_back(allowed[k]);
        }
        return counts;
    };
    const auto mean = [](const std::vector<std::uint64_t>& counts) {
        double sum = 0;
        for (const std::uint64_t n : counts) sum += static_cast<double>(n);
        return sum / static_cast<double>(counts.size());
    };
    const double loudest = noise.empty() ? 0.0 : *std::max_element(noise.begin(), noise.end());
    if (!(loudest > 0.0)) {
        auto most =
            std::upper_bound(allowed.begin(), allowed.end(), average, [](double a, std::uint64_t n) { return a < static_cast<double>(n); });
        return std::vector<std::uint64_t>(noise.size(), most == allowed.begin() ? allowed.front() : *(most - 1));
    }
    double lo = 0.0, hi = 1e12 * static_cast<double>(allowed.back()) / loudest;  // even noise a 10^12th of the loudest gets all there
    if (mean(counts_at(hi)) <= average) return counts_at(hi);
    for (int i = 0; i < 200; ++i) {
        const double middle = lo > 0.0 ? std::sqrt(lo * hi) : hi * 1e-15;
        (mean(counts_at(middle)) <= average ? lo : hi) = middle;
        if (hi <= lo * (1.0 + 1e-12)) break;
    }
    return counts_at(lo);
}

AdaptiveResult render_adaptive(const Scene& scene, const RenderPlan& plan, const SamplerFactory& sampler, PixelRect rect,
                               const AdaptiveSettings& s, int threads) {
    if (sampler.info().kind == SamplerKind::set)
        throw Error(fmt::format("adaptive sampling needs a sequence; the samples of '{}' depend on how many there are", sampler.name()));
    if (s.pilot_scrambles < 2 || s.pilot_spp < 1) throw Error("the pilot of adaptive sampling needs two scrambles or more");
    if (!sampler.randomized()) throw Error(fmt::format("adaptive sampling needs fresh scrambles; '{}' has none", sampler.name()));
    const std::vector<std::uint64_t> allowed = allowed_counts(sampler.info(), s);
    const double pilot_spent = static_cast<double>(s.pilot_scrambles * s.pilot_spp),
                 left = static_cast<double>(s.average_spp) - pilot_spent;
    if (allowed.empty())
        throw Error(fmt::format("no good count of '{}' ({}) lies in [{}, {}]", sampler.name(), sampler.info().good_counts.text(),
                                s.least_spp, s.most_spp));
    if (left < static_cast<double>(allowed.front()))
        throw Error(fmt::format("an average of {} samples leaves {} beside a pilot of {}; expected at least {}", s.average_spp, left,
                                pilot_spent, allowed.front()));

    const std::size_t pixels = static_cast<std::size_t>(rect.area());
    const auto trace = [&](std::uint64_t purpose, const std::vector<std::uint64_t>& counts, std::uint64_t spp) {
        const auto source = sampler.bind(sampling_plan(scene, plan, spp, hash_combine(s.seed, purpose) & ~kReferenceSeedBit));
        return render_counts(scene, plan, *source, rect, counts, threads);
    };
    Pilot pilot;
    for (std::uint64_t k = 0; k < s.pilot_scrambles; ++k) {
        const RenderResult r = trace(1 + k, std::vector<std::uint64_t>(pixels, s.pilot_spp), s.pilot_spp);
        pilot.images.push_back(r.film.image());
        pilot.invalid += r.stats.invalid_samples;
    }
    AdaptiveResult out;
    out.counts = allocate(pilot.noise(rect), allowed, left);
    RenderResult main = trace(0, out.counts, s.most_spp);
    out.invalid_samples = pilot.invalid + main.stats.invalid_samples;
    out.spent_spp = pilot_spent + static_cast<double>(main.stats.paths) / static_cast<double>(pixels);
    out.film = std::move(main.film);
    if (s.mode == AdaptiveMode::one_stage) {
        // The pilot's samples count as any others: a pixel's mean is over all that were traced for it.
        for (std::size_t p = 0; p < pixels; ++p)
            for (const std::vector<float>& image : pilot.images) {
                const Pixel pixel{rect.x + static_cast<std::int32_t>(p) % rect.width, rect.y + static_cast<std::int32_t>(p) / rect.width};
                const std::vector<Vec3f> samples(s.pilot_spp, Vec3f{image[3 * p], image[3 * p + 1], image[3 * p + 2]});
                out.film.add(pixel, samples);
            }
    }
    return out;
}

}  // namespace koksma
