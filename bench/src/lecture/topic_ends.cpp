// How paths end: what truncation leaves out, and what roulette costs.

#include "topics.h"

#include <koksma/integrators/lecture/roulette.h>

#include <fmt/format.h>

#include <cmath>

namespace koksma::lecture {

namespace {

double rays_per_sample(const Replicates& r) { return r.rays_per_sample(); }

/// Bias of a truncation in furnaces: exactly known, and what the ledger says.
void furnace_bias(Sheet& sheet, double albedo) {
    const Lab& lab = sheet.lab();
    const Stage furnace = open("furnace.xml", {{"res", "16"}, {"albedo", fmt::format("{}", albedo)}});
    const double truth = 1 / (1 - albedo);
    const auto bias = [&](const std::string& end, double expected, const char* what) {
        const Replicates r = replicate(lab, furnace, estimator(Technique::bsdf, end), kRandom, 4, 3);
        std::vector<double> relative;
        for (const double m : means(r.images)) relative.push_back(m / truth - 1);
        sheet.check(fmt::format("furnace of albedo {}, {}: relative bias", albedo, end), relative, expected, 1e-4);
        const double cut =
            r.ledger.truncated.weight / static_cast<double>(r.ledger.samples) * (std::string_view(what) == "depth" ? albedo : 1.0);
        sheet.check(fmt::format("furnace of albedo {}, {}: the bias that the ledger tells", albedo, end), {-cut}, expected, 1e-4);
        return -mean_of(relative)["value"].get<double>();
    };
    std::vector<double> depths, by_depth, thresholds, by_threshold, depth_curve, threshold_curve;
    for (const int n : {1, 2, 3, 4, 6, 8, 12, 16}) {
        depths.push_back(n);
        depth_curve.push_back(std::pow(albedo, n));
        by_depth.push_back(bias(fmt::format("depth={}", n), -depth_curve.back(), "depth"));
    }
    for (const double t : {0.5, 0.3, 0.1, 0.03, 0.01}) {
        thresholds.push_back(t);
        // The first power of the albedo below the threshold is the first that is cut (a threshold equal to a power cuts the next).
        double terms = std::ceil(std::log(t) / std::log(albedo) - 1e-9);
        if (std::fabs(std::pow(albedo, terms) - t) < 1e-9) ++terms;
        threshold_curve.push_back(std::pow(albedo, terms));
        by_threshold.push_back(bias(fmt::format("threshold={}", t), -threshold_curve.back(), "threshold"));
    }
    const auto cells = [](const std::vector<double>& y) {
        Json out = Json::array();
        for (const double v : y) out.push_back(exactly(v));
        return out;
    };
    sheet.chart(fmt::format("Furnace of albedo {}: light that is left out, by depth", albedo),
                {"longest path in vertices", "part that is missing", false, true});
    sheet.points("measured", depths, cells(by_depth));
    sheet.known("albedo^n", depths, depth_curve);
    sheet.chart(fmt::format("Furnace of albedo {}: light that is left out, by threshold", albedo),
                {"threshold of the throughput", "part that is missing", true, true});
    sheet.points("measured", thresholds, cells(by_threshold));
    sheet.known("first power of the albedo below the threshold", thresholds, threshold_curve);
}

}  // namespace

void truncation(Sheet& sheet) {
    const Lab& lab = sheet.lab();
    for (const double albedo : {0.5, 0.8}) furnace_bias(sheet, albedo);

    // A room, against the same room with roulette and without a limit.
    const Stage cornell = open_scattered("cornell.xml", {{"res", "48"}, {"max_depth", "-1"}});
    const int n = lab.replicates(16);
    const Replicates whole = replicate(lab, cornell, estimator(Technique::mis), kSobol, 32, n);
    const std::vector<double> truth = means(whole.images);
    const double light = moments(truth).mean;
    sheet.table("cornell without a limit, 32 samples a pixel; light that was scattered once or more",
                {"path ends", "rays a sample", "light that is missing (%)", "RMS bias of a pixel (% of the mean light)"});
    const Image whole_mean = mean_image(whole.images);
    sheet.row({"by roulette (throughput)", rays_per_sample(whole), exactly(0.0), "-"});
    std::vector<double> x[2];
    Json y[2] = {Json::array(), Json::array()};
    for (const char* end : {"depth=1", "depth=2", "depth=3", "depth=4", "depth=6", "depth=8", "depth=12", "threshold=0.5", "threshold=0.2",
                            "threshold=0.1", "threshold=0.05", "threshold=0.02"}) {
        const Replicates cut = replicate(lab, cornell, estimator(Technique::mis, end), kSobol, 32, n);
        std::vector<double> missing;
        const std::vector<double> m = means(cut.images);
        for (std::size_t r = 0; r < m.size(); ++r) missing.push_back(100 * (truth[r] - m[r]) / light);  // pairs of independent replicates
        // Of the difference of two noisy means: their own variance is taken off.
        double bias2 = squared_errors({mean_image(cut.images)}, whole_mean).front();
        bias2 -= (moments(squared_errors(cut.images)).mean + moments(squared_errors(whole.images)).mean) / n;
        sheet.row(
            {end, rays_per_sample(cut), mean_of(missing), bias2 > 0 ? Json(100 * std::sqrt(bias2) / light) : Json("below the noise")});
        const int which = std::string_view(end).starts_with("threshold") ? 1 : 0;
        x[which].push_back(rays_per_sample(cut));
        y[which].push_back(mean_of(missing));
    }
    sheet.chart("cornell: light that is missing, against what the rays cost", {"rays a sample", "missing light (%)", false, true});
    sheet.points("cut by depth", x[0], y[0]);
    sheet.points("cut by threshold", x[1], y[1]);
}

void roulette(Sheet& sheet) {
    const Lab& lab = sheet.lab();
    // S = sum of (albedo / q)^n over survived bounces, W = albedo / q, a = 1 / (1 - albedo W): E[S^2] = a + 2 (a - 1 / (1 - albedo)) / (W -
    // 1).
    constexpr double albedo = 0.6, truth = 1 / (1 - albedo);
    const auto variance = [&](double q) {
        if (q == albedo) return albedo / ((1 - albedo) * (1 - albedo));
        const double w = albedo / q, a = 1 / (1 - albedo * w);
        return a + 2 / (w - 1) * (a - truth) - truth * truth;
    };
    Stage furnace = open("furnace.xml", {{"res", "16"}, {"albedo", "0.6"}});
    furnace.integrator.rr_depth = 0;
    constexpr std::uint64_t kSpp = 64;
    sheet.table("Furnace of albedo 0.6: variance of one sample (64 of them, times 64)",
                {"survival", "roulette's number", "closed form", "random", "Sobol'", "gain by Sobol'", "by the ledger, random"});
    struct Game {
        const char* end;
        double q;
    };
    for (const Game g :
         {Game{"reflectance", albedo}, {"throughput", albedo}, {"constant=0.5", 0.5}, {"constant=0.8", 0.8}, {"constant=0.9", 0.9}})
        for (const RouletteNumber number : {RouletteNumber::own, RouletteNumber::rescaled}) {
            EstimatorSettings s = estimator(Technique::bsdf, g.end);
            s.number = number;
            std::vector<double> v[2];
            double ledger = 0;
            for (const int sobol : {0, 1}) {
                const Replicates r = replicate(lab, furnace, s, sobol == 1 ? kSobol : kRandom, kSpp, lab.replicates(24));
                for (const double e : squared_errors(r.images, Image(r.images.front().size(), static_cast<float>(truth))))
                    v[sobol].push_back(e * kSpp);
                if (sobol == 0) {
                    ledger = r.ledger.roulette.excess / static_cast<double>(r.ledger.samples) * truth * truth;
                    sheet.check(fmt::format("furnace of albedo 0.6, survival {}, number {}: mean", g.end, name(number)), means(r.images),
                                truth);
                    sheet.check(fmt::format("furnace of albedo 0.6, survival {}, number {}: variance of a sample", g.end, name(number)),
                                v[0], variance(g.q));
                }
            }
            sheet.row({g.end, name(number), variance(g.q), mean_of(v[0]), mean_of(v[1]), gain_of(v[1], v[0]), ledger});
        }

    // The slide's own integral.
    const auto square = [](float x) { return static_cast<double>(x) * static_cast<double>(x); };
    sheet.table("I_roulette of f(x) = x^2: N times the MSE", {"P", "N", "closed form (random)", "one number, random", "two numbers, random",
                                                              "one number, Sobol'", "two numbers, Sobol'"});
    const std::uint8_t arities[]{1, 1};
    const DimensionLayout layout = plain_layout(arities);
    for (const float p : {1.0f, 0.5f, 0.1f})
        for (const std::uint64_t n : {16, 256, 4096}) {
            const double known = 1 / (5 * static_cast<double>(p)) - 1.0 / 9;
            std::vector<double> errors[2][2], estimates;
            for (const int sobol : {0, 1})
                for (int r = 0; r < lab.replicates(400); ++r) {
                    const auto source = lab.registry.make(sobol == 1 ? kSobol : kRandom)
                                            ->bind({1, 1, n, lab.seed + 1 + static_cast<std::uint64_t>(r), layout});
                    std::vector<SampleId> ids(n);
                    for (std::uint64_t i = 0; i < n; ++i) ids[i].index = i;
                    std::vector<float> u(2 * n);
                    source->fill(ids, layout.slots(), u.data(), n);
                    double one = 0, two = 0;
                    for (std::size_t i = 0; i < n; ++i) {
                        one += i_roulette(square, u[i], p) / static_cast<double>(n);
                        two += i_roulette(square, u[i], u[n + i], p) / static_cast<double>(n);
                    }
                    const auto scaled = [&](double estimate) {
                        return (estimate - 1.0 / 3) * (estimate - 1.0 / 3) * static_cast<double>(n);
                    };
                    errors[sobol][0].push_back(scaled(one));
                    errors[sobol][1].push_back(scaled(two));
                    if (sobol == 0) estimates.push_back(one);
                }
            sheet.row({static_cast<double>(p), n, known, mean_of(errors[0][0]), mean_of(errors[0][1]), mean_of(errors[1][0]),
                       mean_of(errors[1][1])});
            if (n == 256) {
                sheet.check(fmt::format("I_roulette of x^2, P = {}: mean", p), estimates, 1.0 / 3);
                sheet.check(fmt::format("I_roulette of x^2, P = {}: variance, one number", p), errors[0][0], known);
                sheet.check(fmt::format("I_roulette of x^2, P = {}: variance, two numbers", p), errors[0][1], known);
            }
        }
    sheet.note(
        "For independent numbers both have one variance. A sequence sees with one number f up to a jump of f(1) / P at x = P, which is on "
        "the border of a stratum where P is a power of two; with two numbers a jump along a line of the square, whose mean height is "
        "less.");

    // A room, where the direction matters too.
    Stage cornell = open_scattered("cornell.xml", {{"res", "48"}, {"max_depth", "-1"}});
    cornell.integrator.rr_depth = 0;
    sheet.table("cornell, 16 samples a pixel, roulette from the first bounce on",
                {"survival", "RMSE, own number, random", "RMSE, own number, Sobol'", "RMSE, rescaled, random", "RMSE, rescaled, Sobol'",
                 "MSE gain of rescaling, Sobol'"});
    for (const char* end : {"reflectance", "throughput", "constant=0.5"}) {
        std::vector<double> e[2][2];
        for (const int rescale : {0, 1})
            for (const int sobol : {0, 1}) {
                EstimatorSettings s = estimator(Technique::mis, end);
                s.number = rescale == 1 ? RouletteNumber::rescaled : RouletteNumber::own;
                e[rescale][sobol] =
                    squared_errors(replicate(lab, cornell, s, sobol == 1 ? kSobol : kRandom, 16, lab.replicates(16)).images);
            }
        sheet.row({end, root_of(e[0][0]), root_of(e[0][1]), root_of(e[1][0]), root_of(e[1][1]), gain_of(e[1][1], e[0][1])});
    }
}

void absorption(Sheet& sheet) {
    const Lab& lab = sheet.lab();
    const int n = lab.replicates(12);
    constexpr std::uint64_t kSpp = 16;
    for (const char* name : {"cornell", "caustic"}) {
        Stage stage = open_scattered(std::string(name) + ".xml", {{"res", "64"}, {"max_depth", "64"}});
        sheet.table(fmt::format("{}, {} samples a pixel, roulette from the first bounce on unless said otherwise", name, kSpp),
                    {"path ends", "rays a sample", "RMSE, random", "RMSE, Sobol'", "MSE x rays over that of reflectance, random",
                     "variance added by roulette (ledger, x L^2)"});
        std::vector<double> baseline;
        double baseline_rays = 0;
        struct Game {
            const char* end;
            int from;
            const char* label;
        };
        for (const Game g : {Game{"reflectance", 0, "absorption = 1 - reflectance"},
                             {"throughput", 0, "by throughput"},
                             {"throughput", 5, "by throughput, from 5 vertices on"},
                             {"constant=0.7", 0, "constant, 0.7"},
                             {"none", 0, "none, 64 vertices"}}) {
            stage.integrator.rr_depth = g.from;
            const Replicates random = replicate(lab, stage, estimator(Technique::mis, g.end), kRandom, kSpp, n),
                             sobol = replicate(lab, stage, estimator(Technique::mis, g.end), kSobol, kSpp, n);
            const std::vector<double> a = squared_errors(random.images), b = squared_errors(sobol.images);
            if (baseline.empty()) {
                baseline = a;
                baseline_rays = random.rays_per_sample();
            }
            sheet.row({g.label, random.rays_per_sample(), root_of(a), root_of(b),
                       gain_of(baseline, a, random.rays_per_sample() / baseline_rays),
                       random.ledger.roulette.excess / static_cast<double>(random.ledger.samples)});
        }
    }
}

}  // namespace koksma::lecture
