// How light is found, and how directions are drawn.

#include "topics.h"

#include <fmt/format.h>

namespace koksma::lecture {

namespace {

constexpr int kRes = 96;
constexpr std::uint64_t kSpp = 16;

}  // namespace

void direct_light(Sheet& sheet) {
    const Lab& lab = sheet.lab();
    const int n = lab.replicates(12);
    for (const char* name : {"cornell", "veach"}) {
        const Stage stage = open_scattered(std::string(name) + ".xml", {{"res", "64"}}),
                    shown = open(std::string(name) + ".xml", {{"res", std::to_string(kRes)}});
        sheet.table(fmt::format("{}, {} samples a pixel; light that was scattered once or more", name, kSpp),
                    {"light is found", "rays a sample", "RMSE, random", "RMSE, Sobol'", "MSE gain over meeting it, random",
                     "the same at equal rays", "mean, random"});
        std::vector<double> baseline;
        double baseline_rays = 0;
        for (const Technique light : {Technique::bsdf, Technique::light, Technique::mis}) {
            const Replicates random = replicate(lab, stage, estimator(light), kRandom, kSpp, n),
                             sobol = replicate(lab, stage, estimator(light), kSobol, kSpp, n);
            const std::vector<double> a = squared_errors(random.images), b = squared_errors(sobol.images);
            if (light == Technique::bsdf) {
                baseline = a;
                baseline_rays = random.rays_per_sample();
            }
            const char* label = light == Technique::bsdf    ? "by meeting it"
                                : light == Technique::light ? "by sampling it"
                                                                : "both, weighted (MIS)";
            sheet.row({label, random.rays_per_sample(), root_of(a), root_of(b), gain_of(a, baseline),
                       gain_of(a, baseline, baseline_rays / random.rays_per_sample()), mean_of(means(random.images))});
            sheet.picture(fmt::format("{}: {}", name, label), replicate(lab, shown, estimator(light), kRandom, kSpp, 1).images.front(),
                          kRes, kRes, name == std::string("cornell") ? 1.6f : 0.0f);
        }
    }
    sheet.note(
        "All three are estimates of one picture: their means agree. What the lamps send straight into the camera is the same in all of "
        "them, and left out of the errors.");
}

void directions(Sheet& sheet) {
    const Lab& lab = sheet.lab();
    // Walls that shine evenly with radiance 1 and reflect a part rho: after one bounce a direction from the BSDF always brings rho, a
    // uniform one 2 rho cos(theta), whose variance is 4 rho^2 (1/3 - 1/4).
    for (const double albedo : {0.5, 0.8}) {
        Stage furnace = open("furnace.xml", {{"res", "32"}, {"max_depth", "2"}, {"albedo", fmt::format("{}", albedo)}});
        for (const DirectionStrategy direction : {DirectionStrategy::bsdf, DirectionStrategy::uniform}) {
            EstimatorSettings s = estimator(Technique::bsdf, "none");
            s.direction = direction;
            const Replicates r = replicate(lab, furnace, s, kRandom, 16, lab.replicates(32));
            sheet.check(fmt::format("furnace of albedo {}, one bounce, directions {}: mean", albedo, name(direction)), means(r.images),
                        1 + albedo);
            std::vector<double> variance;
            for (const double e : squared_errors(r.images, Image(r.images.front().size(), static_cast<float>(1 + albedo))))
                variance.push_back(16 * e);
            const double expected = direction == DirectionStrategy::uniform ? albedo * albedo / 3 : 0.0;
            sheet.check(fmt::format("furnace of albedo {}, one bounce, directions {}: variance of a sample", albedo, name(direction)),
                        variance, expected);
        }
    }
    const int n = lab.replicates(12);
    sheet.table(
        fmt::format("{} samples a pixel; light that was scattered once or more", kSpp),
        {"scene", "light is found", "RMSE, uniform", "RMSE, from the BSDF", "MSE gain by the BSDF, random", "the same with Sobol'"});
    for (const char* name : {"cornell", "veach"})
        for (const Technique light : {Technique::bsdf, Technique::light, Technique::mis}) {
            const Stage stage = open_scattered(std::string(name) + ".xml", {{"res", "64"}});
            std::vector<double> errors[2][2];
            for (const int uniform : {0, 1})
                for (const int sobol : {0, 1}) {
                    EstimatorSettings s = estimator(light);
                    s.direction = uniform == 1 ? DirectionStrategy::uniform : DirectionStrategy::bsdf;
                    const Replicates r = replicate(lab, stage, s, sobol == 1 ? kSobol : kRandom, kSpp, n);
                    errors[uniform][sobol] = squared_errors(r.images);
                    if (sobol == 0 && light == Technique::bsdf)
                        sheet.picture(fmt::format("{}: {}", name, uniform == 1 ? "uniform" : "from the BSDF"), r.images.front(), 64, 64,
                                      name == std::string("cornell") ? 1.6f : 0.0f);
                }
            const char* label = light == Technique::bsdf ? "by meeting it" : light == Technique::light ? "by sampling it" : "both";
            sheet.row({name, label, root_of(errors[1][0]), root_of(errors[0][0]), gain_of(errors[0][0], errors[1][0]),
                       gain_of(errors[0][1], errors[1][1])});
        }
}

}  // namespace koksma::lecture
