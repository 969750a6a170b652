// Light by the number of its bounces: the terms of the Neumann series, one by one and in three parts.

#include "topics.h"

#include <fmt/format.h>

#include <cmath>

namespace koksma::lecture {

namespace {

constexpr int kRes = 96;
constexpr std::uint64_t kSpp = 16;

std::vector<Image> sums_of_terms(const Replicates& r, std::size_t first, std::size_t last) {
    std::vector<Image> out;
    for (std::size_t i = 0; i < r.images.size(); ++i) {
        std::vector<Image> terms;
        for (std::size_t k = first; k <= last; ++k) terms.push_back(r.terms[k][i]);
        out.push_back(sum_of(terms));
    }
    return out;
}

}  // namespace

void bounces(Sheet& sheet) {
    const Lab& lab = sheet.lab();
    const Stage cornell = open("cornell.xml", {{"res", std::to_string(kRes)}});
    const int n = lab.replicates(12);
    const Replicates random = replicate(lab, cornell, estimator(Technique::mis), kRandom, kSpp, n, true);
    const Replicates sobol = replicate(lab, cornell, estimator(Technique::mis), kSobol, kSpp, n, true);

    sheet.table(fmt::format("cornell, {} samples a pixel: light by the number of its bounces", kSpp),
                {"bounces", "mean of the picture's light", "share", "RMSE of this term, random", "RMSE of this term, Sobol'",
                 "MSE gain by Sobol'"});
    double total = 0;
    for (const double m : means(sobol.images)) total += m / n;
    std::vector<double> x;
    Json share = Json::array(), random_error = Json::array(), sobol_error = Json::array();
    for (std::size_t k = 0; k < NeumannSeries::kTerms; ++k) {
        const std::vector<double> a = squared_errors(random.terms[k]), b = squared_errors(sobol.terms[k]);
        const Json mean = mean_of(means(sobol.terms[k]));
        sheet.row({k + 1 == NeumannSeries::kTerms ? fmt::format("{} or more", k) : std::to_string(k), mean, times(mean, 1 / total),
                   root_of(a), root_of(b), gain_of(b, a)});
        x.push_back(static_cast<double>(k));
        share.push_back(times(mean, 1 / total));
        random_error.push_back(root_of(a));
        sobol_error.push_back(root_of(b));
    }
    sheet.chart("Share of the light that was scattered so often", {"bounces", "share of the mean", false, true});
    sheet.points("cornell", x, share);
    sheet.chart("Error of each term", {"bounces", "RMSE", false, true});
    sheet.points("random", x, random_error);
    sheet.points("Sobol'", x, sobol_error);

    Image one_more(sobol.images.front().size());
    for (std::size_t k = 0; k <= 6; ++k) {
        one_more = sum_of({one_more, sobol.terms[k].front()});
        sheet.picture(k == 0 ? "0 bounces" : fmt::format("up to {} bounce{}", k, k == 1 ? "" : "s"), one_more, kRes, kRes, 1.6f);
    }

    // The furnace: every surface shines with 1 and reflects a half, so that term k is 1 / 2^k.
    Stage furnace = open("furnace.xml", {{"res", "16"}});
    furnace.integrator.rr_depth = 0;
    const Replicates white = replicate(lab, furnace, estimator(Technique::bsdf), kRandom, 64, lab.replicates(16), true);
    for (std::size_t k = 0; k <= 6; ++k)
        sheet.check(fmt::format("furnace of albedo 0.5: light scattered {} times", k), means(white.terms[k]),
                    std::pow(0.5, static_cast<double>(k)));
}

void parts(Sheet& sheet) {
    const Lab& lab = sheet.lab();
    const int n = lab.replicates(12);
    for (const char* name : {"cornell", "veach"}) {
        const Stage stage = open(std::string(name) + ".xml", {{"res", std::to_string(kRes)}});
        const Replicates random = replicate(lab, stage, estimator(Technique::mis), kRandom, kSpp, n, true);
        const Replicates sobol = replicate(lab, stage, estimator(Technique::mis), kSobol, kSpp, n, true);
        sheet.table(fmt::format("{}, {} samples a pixel", name, kSpp),
                    {"part", "mean", "RMSE, random", "RMSE, Sobol'", "MSE gain by Sobol'"});
        struct Part {
            const char* name;
            std::size_t first, last;
        };
        for (const Part p :
             {Part{"Le", 0, 0}, {"Ldirect", 1, 1}, {"Lindirect", 2, NeumannSeries::kTerms - 1}, {"all", 0, NeumannSeries::kTerms - 1}}) {
            const std::vector<Image> a = sums_of_terms(random, p.first, p.last), b = sums_of_terms(sobol, p.first, p.last);
            const std::vector<double> ea = squared_errors(a), eb = squared_errors(b);
            sheet.row({p.name, mean_of(means(b)), root_of(ea), root_of(eb), gain_of(eb, ea)});
            sheet.picture(fmt::format("{}: {}", name, p.name), b.front(), kRes, kRes, 1.6f);
        }
    }
}

}  // namespace koksma::lecture
