// Path tracing against stochastic ray tracing: one ray on from every vertex, or several.

#include "topics.h"

#include <koksma/measure/ratio.h>

#include <fmt/format.h>

#include <cmath>

namespace koksma::lecture {

void branching(Sheet& sheet) {
    const Lab& lab = sheet.lab();
    constexpr double kMostRays = 4000;
    constexpr double kBudget = 1024;  // rays a pixel, at which all are compared
    const Stage stage = open_scattered("cornell.xml", {{"res", "16"}, {"max_depth", "4"}});
    const int n = lab.replicates(12);
    for (const bool sobol : {false, true}) {
        const std::string sampler = sobol ? kSobol : kRandom;
        sheet.table(
            fmt::format("cornell, paths of up to 4 vertices, {}: MSE of light that was scattered once or more",
                        sobol ? "Sobol'" : "random"),
            {"branching", "rays through a pixel", "rays in all", "MSE", "MSE x rays", sobol ? "" : "N x MSE over that of one camera ray"});
        sheet.chart(fmt::format("MSE against rays, {}", sobol ? "Sobol'" : "random"), {"rays a pixel in all", "MSE", true, true});
        struct At {
            double rays;
            std::vector<double> errors;
        };
        std::vector<std::pair<std::uint32_t, std::vector<At>>> curves;
        for (const std::uint32_t b : {1u, 2u, 4u, 8u}) {
            std::vector<At> curve;
            Json y = Json::array();
            std::vector<double> x;
            for (std::uint64_t spp = 1; spp <= 1024; spp *= 4) {
                if (!curve.empty() && curve.back().rays * 4 > kMostRays) break;
                const Replicates r = replicate(lab, stage, estimator(Technique::mis, "none", b), sampler, spp, n);
                curve.push_back({r.rays_per_pixel(), squared_errors(r.images)});
                const At& at = curve.back();
                x.push_back(at.rays);
                y.push_back(error_of(at.errors));
                sheet.row({b, spp, at.rays, error_of(at.errors), times(error_of(at.errors), at.rays),
                           sobol ? Json("") : gain_of(curve.front().errors, at.errors, static_cast<double>(spp))});
            }
            sheet.points(fmt::format("branching {}", b), x, y);
            curves.emplace_back(b, std::move(curve));
        }
        // At equally many rays, between measured points by straight lines in log-log.
        sheet.table(fmt::format("At {} rays a pixel, {} (between measured points by straight lines in log-log)", kBudget,
                                sobol ? "Sobol'" : "random"),
                    {"branching", "MSE over that of path tracing"});
        const auto around = [&](const std::vector<At>& curve) {
            std::size_t above = 1;
            while (above + 1 < curve.size() && curve[above].rays < kBudget) ++above;
            return above;
        };
        const std::vector<At>& paths = curves.front().second;
        for (const auto& [b, curve] : curves) {
            const std::size_t i = around(curve), j = around(paths);
            if (curve.size() < 2 || curve[i].rays < kBudget || curve[i - 1].rays > kBudget) continue;
            const auto weight = [&](const std::vector<At>& c, std::size_t above) {
                return (std::log(kBudget) - std::log(c[above - 1].rays)) / (std::log(c[above].rays) - std::log(c[above - 1].rays));
            };
            if (b == 1) {
                sheet.row({b, 1.0});
                continue;
            }
            // Both lie between points: the nearer point of path tracing, carried to the budget by its own slope, is what is compared with.
            const double w = weight(paths, j);
            const double path_mse =
                std::exp((1 - w) * std::log(moments(paths[j - 1].errors).mean) + w * std::log(moments(paths[j].errors).mean));
            const double scale = path_mse / moments(paths[j].errors).mean;
            const Gain g = interpolated_gain(paths[j].errors, curve[i - 1].errors, curve[i].errors, weight(curve, i));
            sheet.row({b, Json{{"value", g.value / scale}, {"lo", g.lo / scale}, {"hi", g.hi / scale}}});
        }
    }

    // With one bounce, n times the MSE is the variance of the camera's numbers plus that of the bounce over B.
    const Stage one_bounce = open_scattered("cornell.xml", {{"res", "24"}, {"max_depth", "2"}});
    const int many = lab.replicates(32);
    const auto variance = [&](std::uint32_t b) {
        std::vector<double> v;
        for (const double e :
             squared_errors(replicate(lab, one_bounce, estimator(Technique::mis, "none", b), kRandom, 16, many).images))
            v.push_back(16 * e);
        return v;
    };
    const std::vector<double> v1 = variance(1), v2 = variance(2);
    sheet.table("cornell, one bounce: variance of a sample, and that from branching 1 and 2 by V(B) = Vcamera + Vbounce / B",
                {"branching", "variance", "predicted"});
    for (const std::uint32_t b : {1u, 2u, 4u, 8u}) {
        const std::vector<double> v = b == 1 ? v1 : b == 2 ? v2 : variance(b);
        std::vector<double> predicted, difference;
        for (std::size_t r = 0; r < v.size(); ++r) {
            predicted.push_back(v1[r] * (2.0 / b - 1) + v2[r] * (2 - 2.0 / b));
            difference.push_back(v[r] - predicted.back());
        }
        sheet.row({b, mean_of(v), mean_of(predicted)});
        if (b > 2)
            sheet.check(fmt::format("cornell, one bounce, branching {}: variance less what branching 1 and 2 predict", b), difference, 0.0);
    }
}

}  // namespace koksma::lecture
