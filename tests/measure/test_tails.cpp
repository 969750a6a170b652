// How often heavy_tailed() speaks, by law; its numbers are in koksma/measure/tails.h:  test_measure "[tails]" -s

#include "laws.h"

#include <koksma/measure/tails.h>
#include <koksma_catch.h>

using namespace koksma;
using namespace koksma::test;

TEST_CASE("curves of heavy-tailed replicates are told from those whose intervals cover", "[unit][measure][tails]") {
    struct Case {
        Law law;
        double least, most;
    };
    for (const Case& c : {Case{chi2_law(0.02), 0, 0}, Case{chi2_law(0.25), 0, 0.005}, Case{chi2_law(0.5), 0.5, 0.7}, Case{lognormal_law(1), 0.98, 1},
                          Case{pareto_law(3), 0.55, 0.7}, Case{pareto_law(2.1), 0.87, 0.94}}) {
        const double told = coverage(2000, [&](Generator& g) {
            std::vector<std::vector<double>> points;
            for (int i = 0; i < 5; ++i) points.push_back(replicates(c.law, 8, std::ldexp(1.0, -2 * i), g));
            return heavy_tailed(points);
        });
        CAPTURE(c.law.name, told);
        CHECK(told >= c.least);
        CHECK(told <= c.most);
    }
}

TEST_CASE("little is known of few replicates", "[unit][measure]") {
    CHECK_FALSE(heavy_tailed({}));
    CHECK_FALSE(heavy_tailed({{1, 100}}));
    CHECK_FALSE(heavy_tailed({{-1, -1, 100}}));
    CHECK(heavy_tailed({{1, 1, 1}, {1, 1, 2.6}}));
    CHECK_FALSE(heavy_tailed({{1, 1, 2.4}}));
}
