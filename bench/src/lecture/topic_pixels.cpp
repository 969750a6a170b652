// How many rays a pixel, where in it, and by which numbers.

#include "topics.h"

#include <koksma/measure/slope.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace koksma::lecture {

void rays(Sheet& sheet) {
    const Lab& lab = sheet.lab();
    constexpr int kRes = 96;
    const Stage stage = open_scattered("cornell.xml", {{"res", std::to_string(kRes)}}),
                shown = open("cornell.xml", {{"res", std::to_string(kRes)}});
    sheet.table("cornell: light that was scattered once or more",
                {"rays a pixel", "RMSE, random", "RMSE, Sobol'", "MSE gain by Sobol'", "n x MSE over that of 1 ray, random"});
    sheet.chart("Error against rays", {"rays a pixel", "RMSE", true, true});
    std::vector<double> x, first;
    Json random = Json::array(), sobol = Json::array();
    const int n = lab.replicates(12);
    for (const std::uint64_t spp : {1, 4, 16, 256}) {
        const std::vector<Image> a = replicate(lab, stage, kRandom, spp, n), b = replicate(lab, stage, kSobol, spp, n);
        const std::vector<double> ea = squared_errors(a), eb = squared_errors(b);
        if (first.empty()) first = ea;
        sheet.row({spp, root_of(ea), root_of(eb), gain_of(eb, ea), gain_of(first, ea, static_cast<double>(spp))});
        x.push_back(static_cast<double>(spp));
        random.push_back(root_of(ea));
        sobol.push_back(root_of(eb));
        sheet.picture(fmt::format("random: {} ray{}", spp, spp == 1 ? "" : "s"), replicate(lab, shown, kRandom, spp, 1).front(), kRes, kRes,
                      1.6f);
        if (spp > 1) {
            std::vector<double> law;  // independent replicates of both counts in pairs
            for (std::size_t r = 0; r < ea.size(); ++r) law.push_back(static_cast<double>(spp) * ea[r] - first[r]);
            sheet.check(fmt::format("cornell, random: {} x MSE of {} rays less the MSE of one", spp, spp), law, 0.0);
        }
    }
    for (const std::uint64_t spp : {1, 4, 16, 256})
        sheet.picture(fmt::format("Sobol': {} ray{}", spp, spp == 1 ? "" : "s"), replicate(lab, shown, kSobol, spp, 1).front(), kRes, kRes,
                      1.6f);
    sheet.points("random", x, random);
    sheet.points("Sobol'", x, sobol);
    std::vector<double> law;
    for (const double n_rays : x) law.push_back(random[0]["value"].get<double>() / std::sqrt(n_rays));
    sheet.known("1 / sqrt(n)", x, law);
}

void antialiasing(Sheet& sheet) {
    const Lab& lab = sheet.lab();
    const int n = lab.replicates(12);
    // The board: the mean over a pixel of s(u) s(v), s a square wave of period 1, is a product of means over its sides.
    constexpr int kRes = 64, kSquares = 75;
    const Stage board = open("lecture/board.xml", {{"res", std::to_string(kRes)}, {"squares", std::to_string(kSquares)}});
    const auto integral = [](double t) {  // of the square wave: +1 in the lower half of its period, -1 in the upper
        const double part = t - std::floor(t);
        return part < 0.5 ? part : 1 - part;
    };
    std::vector<double> side;
    for (int i = 0; i < kRes; ++i) {
        const double a = static_cast<double>(i) * kSquares / kRes, b = static_cast<double>(i + 1) * kSquares / kRes;
        side.push_back((integral(b) - integral(a)) / (b - a));
    }
    Image truth;
    double coin = 0;
    for (int y = 0; y < kRes; ++y)
        for (int x = 0; x < kRes; ++x) {
            // u grows to the right, v upwards; color1 shines where one of the two is in the upper half of its period.
            const double c = 0.5 * (1 - side[static_cast<std::size_t>(x)] * side[static_cast<std::size_t>(kRes - 1 - y)]);
            for (int k = 0; k < 3; ++k) truth.push_back(static_cast<float>(c));
            coin += c * (1 - c) / (kRes * kRes);
        }
    sheet.table("The board: RMSE against the known picture",
                {"rays a pixel", "through the centre", "all over the pixel, random", "all over the pixel, Sobol'", "closed form, random"});
    sheet.chart("The board: error against rays", {"rays a pixel", "RMSE", true, true});
    std::vector<double> counts, known;
    Json centre_y = Json::array(), random_y = Json::array(), sobol_y = Json::array();
    for (const std::uint64_t spp : {1, 4, 16, 64, 256}) {
        const std::vector<Image> centre = replicate(lab, board, kRandom, spp, 2, true), random = replicate(lab, board, kRandom, spp, n),
                                 sobol = replicate(lab, board, kSobol, spp, n);
        const std::vector<double> e = squared_errors(random, truth), es = squared_errors(sobol, truth);
        const double c = std::sqrt(squared_errors(centre, truth).front());
        counts.push_back(static_cast<double>(spp));
        known.push_back(std::sqrt(coin / static_cast<double>(spp)));
        sheet.row({spp, c, root_of(e), root_of(es), known.back()});
        centre_y.push_back(exactly(c));
        random_y.push_back(root_of(e));
        sobol_y.push_back(root_of(es));
        sheet.check(fmt::format("board, {} random rays a pixel: MSE", spp), e, coin / static_cast<double>(spp));
        if (spp == 256) {
            sheet.picture("board: through the centre", centre.front(), kRes, kRes, 1.0f);
            sheet.picture("board: all over the pixel, 256 rays", sobol.front(), kRes, kRes, 1.0f);
            sheet.picture("board: the known picture", truth, kRes, kRes, 1.0f);
        }
    }
    sheet.points("centre", counts, centre_y);
    sheet.points("random", counts, random_y);
    sheet.points("Sobol'", counts, sobol_y);
    sheet.known("sqrt(mean c (1 - c) / n)", counts, known);

    constexpr int kFloor = 128;
    const Stage floor = open("lecture/floor.xml", {{"res", std::to_string(kFloor)}});
    sheet.picture("floor: through the centre", replicate(lab, floor, kRandom, 1, 1, true).front(), kFloor, kFloor, 1.0f);
    for (const std::uint64_t spp : {1, 16, 256})
        sheet.picture(fmt::format("floor: {} random ray{} all over the pixel", spp, spp == 1 ? "" : "s"),
                      replicate(lab, floor, kRandom, spp, 1).front(), kFloor, kFloor, 1.0f);
    sheet.picture("floor: 16 rays all over the pixel, Sobol'", replicate(lab, floor, kSobol, 16, 1).front(), kFloor, kFloor, 1.0f);
}

void sequences(Sheet& sheet) {
    const Lab& lab = sheet.lab();
    const int n = lab.replicates(8);
    const std::vector<std::pair<const char*, std::string>> samplers{
        {"random", kRandom}, {"stratified", "stratified"}, {"Halton", "halton:randomize=owen"}, {"Sobol'", kSobol}};
    for (const char* name : {"smooth", "penumbra", "cornell"}) {
        const Stage stage = open_scattered(std::string(name) + ".xml", {{"res", "48"}});
        sheet.table(fmt::format("{}: RMSE of light that was scattered once or more", name),
                    {"sampler", "4", "16", "64", "256", "slope, 4 to 256", "MSE gain over random at 256"});
        sheet.chart(fmt::format("{}: error against samples", name), {"samples a pixel", "RMSE", true, true});
        std::vector<double> baseline;
        for (const auto& [label, sampler] : samplers) {
            std::vector<double> x;
            std::vector<RatePoint> fit;
            Json cells{label}, y = Json::array();
            for (const std::uint64_t spp : {4, 16, 64, 256}) {
                const std::vector<double> e = squared_errors(replicate(lab, stage, sampler, spp, n));
                x.push_back(static_cast<double>(spp));
                y.push_back(root_of(e));
                cells.push_back(root_of(e));
                fit.push_back({static_cast<double>(spp), e});
            }
            if (baseline.empty()) baseline = fit.back().errors;
            const SlopeFit slope = fit_slope(fit);
            cells.push_back(Json{{"value", slope.value}, {"lo", slope.lo}, {"hi", slope.hi}});
            cells.push_back(gain_of(fit.back().errors, baseline));
            sheet.row(cells);
            sheet.points(label, x, y);
        }
    }
    sheet.note(
        "Six scenes, four samplers and their reference images: koksma bench. Which random decisions a gain comes from: koksma bench budget "
        "SCENE.");
}

}  // namespace koksma::lecture
