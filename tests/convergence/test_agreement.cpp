// Slopes against a table of rates made elsewhere, for every pair of a sampler and an integrand that both have: printed, and held to
// the width of their intervals. Needs KOKSMA_RATES_TSV, the table's path; columns sampler, integrand, dim, slope, rmse1024
// and slope_sd_R256 by name, fitted over N = 2^6 .. 2^14 with 256 replicates. Without it, nothing is compared:
// bands.tsv, which the tests beside this one read, carries the rows that a build must hold, levels with their own spread included.
//     KOKSMA_RATES_TSV=rates.tsv build/release/bin/test_convergence "slopes agree with a table of rates made elsewhere"
// The ratio of levels is printed, and not held to a width of its own: with `step`, where a sampler has one point in each stratum, the
// error has two values, and at N = 1024 the larger one comes in one replicate of twenty. 256 replicates meet it 13.0 +- 3.5 times, so two
// levels of correct samplers differ by a factor of two now and then (stratified here 21 times, jitter there 5). For these the second test
// counts the replicates from both levels and holds both to the binomial law.

#include "bands.h"

#include <koksma_catch.h>

#include <cstdio>
#include <cstdlib>
#include <map>

using namespace koksma;
using namespace koksma::convergence;

namespace {

struct Row {
    double slope = 0, sd = 0, rmse_1024 = 0;
};
using Rows = std::map<std::tuple<std::string, std::string, int>, Row>;

Rows load(const std::string& path) {
    std::ifstream file(path);
    if (!file) throw std::runtime_error("cannot read " + path);
    std::map<std::string, std::size_t> column;
    Rows rows;
    for (std::string line; std::getline(file, line);) {
        if (line.empty() || line.front() == '#') continue;
        std::vector<std::string> cells;
        std::istringstream in(line);
        for (std::string cell; std::getline(in, cell, '\t');) cells.push_back(cell);
        if (column.empty()) {
            for (std::size_t k = 0; k < cells.size(); ++k) column[cells[k]] = k;
            continue;
        }
        const auto number = [&](const char* name) { return std::strtod(cells.at(column.at(name)).c_str(), nullptr); };
        rows[{cells.at(column.at("sampler")), cells.at(column.at("integrand")), static_cast<int>(number("dim"))}] = {
            number("slope"), number("slope_sd_R256"), number("rmse1024")};
    }
    return rows;
}

struct Common {
    std::string spec, row;
    int step = 1;             ///< of log2 N; 2 for squares
    int most_dimensions = 6;  ///< beyond, the two are different samplers
    int least_dimensions = 1;
};

constexpr double kReplicates = 256;

/// How many of the replicates misjudged the stratum that 1/pi cuts the seldom way, from the RMSE of `step`. With phi the share of the
/// stratum that is below 1/pi, its point is below with probability phi: the error is (1 - phi) / N then, and -phi / N else.
struct Seldom {
    double probability, common_square, seldom_square;
    explicit Seldom(double n) {
        const double phi = n * kStepAt - std::floor(n * kStepAt), least = std::min(phi, 1 - phi);
        probability = least;
        common_square = least * least / (n * n);
        seldom_square = (1 - least) * (1 - least) / (n * n);
    }
    [[nodiscard]] double expected() const { return kReplicates * probability; }
    [[nodiscard]] double sd() const { return std::sqrt(kReplicates * probability * (1 - probability)); }
    [[nodiscard]] double count(double rmse) const { return kReplicates * (rmse * rmse - common_square) / (seldom_square - common_square); }
};

}  // namespace

TEST_CASE("slopes agree with a table of rates made elsewhere", "[convergence]") {
    const char* path = std::getenv("KOKSMA_RATES_TSV");
    if (path == nullptr) {
        SUCCEED("KOKSMA_RATES_TSV is not set");
        return;
    }
    const Rows rows = load(path);
    Registry registry;
    register_samplers(registry);
    const std::vector<Common> common{{"random", "random"}, {"halton:randomize=cp", "halton_cp"}, {"halton:randomize=digits", "halton_rdp"},
                                     {"halton:randomize=owen", "halton_owen"}, {"sobol:randomize=xor", "sobol_xor"}, {"sobol:randomize=owen", "sobol_owen"},
                                     {"sobol-padded", "sobol_pad2"}, {"lhs", "lhs"}, {"stratified", "jitter", 2, 2},
                                     {"multijitter:order=independent", "mj2", 2, 2}, {"kronecker", "kron", 1, 2, 2}};
    int compared = 0, agree = 0;
    std::printf("%-32s %-12s %8s %8s %8s %8s\n", "sampler", "integrand", "slope", "theirs", "+-", "log2 of RMSE ratio at 1024");
    for (const Common& c : common) {
        const auto factory = registry.make(c.spec);
        for (const std::span<const Integrand> part : {std::span<const Integrand>(kOneDimensional), std::span<const Integrand>(kMultiDimensional)}) {
            std::vector<Integrand> wanted;
            for (const Integrand& f : part)
                if (f.dimensions >= c.least_dimensions && f.dimensions <= c.most_dimensions && rows.contains({c.row, std::string(f.name), int{f.dimensions}})) wanted.push_back(f);
            if (wanted.empty()) continue;
            for (const Rates& r : run_rates(*factory, wanted, {.counts = powers_of_two(6, 14, c.step)})) {
                const Row& row = rows.at({c.row, std::string(r.integrand.name), int{r.integrand.dimensions}});
                const double width = slope_width(row.sd, c.step == 1 ? 1.0 : 1.22), level = std::log2(r.at(1024).rmse / row.rmse_1024);
                const bool ok = std::abs(r.slope - row.slope) < width;
                std::printf("%-32s %-10s %d %8.3f %8.3f %8.3f %8.3f%s\n", r.sampler.c_str(), std::string(r.integrand.name).c_str(), int{r.integrand.dimensions},
                            r.slope, row.slope, width, level, ok ? "" : "  DISAGREES");
                INFO(r.sampler << " on " << r.integrand.name << int{r.integrand.dimensions});
                CHECK(ok);
                ++compared;
                agree += ok;
            }
        }
    }
    std::printf("%d of %d slopes agree\n", agree, compared);
    std::fflush(stdout);
    CHECK(compared > 0);
}

TEST_CASE("levels of a step agree with a table of rates made elsewhere, counted in replicates", "[convergence]") {
    const char* path = std::getenv("KOKSMA_RATES_TSV");
    if (path == nullptr) {
        SUCCEED("KOKSMA_RATES_TSV is not set");
        return;
    }
    const Rows rows = load(path);
    Registry registry;
    register_samplers(registry);
    const Seldom law(1024);
    std::printf("step at N = 1024: of 256 replicates %.1f +- %.1f misjudge the stratum of 1/pi by nearly all of it\n", law.expected(), law.sd());
    std::printf("%-32s %8s %8s\n", "sampler", "ours", "theirs");
    for (const auto& [spec, row] : {std::pair{"halton:randomize=cp", "halton_cp"}, {"halton:randomize=digits", "halton_rdp"}, {"halton:randomize=owen", "halton_owen"},
                                    {"sobol:randomize=xor", "sobol_xor"}, {"sobol:randomize=owen", "sobol_owen"}, {"sobol-padded", "sobol_pad2"}, {"lhs", "lhs"},
                                    {"stratified", "jitter"}}) {
        const double ours = law.count(run_rates(*registry.make(spec), kStep, {.counts = {1024}}).at(1024).rmse);
        const double theirs = law.count(rows.at({row, "step", 1}).rmse_1024);
        std::printf("%-32s %8.1f %8.1f\n", spec, ours, theirs);
        for (const double count : {ours, theirs}) {
            INFO(spec << ": " << count << " replicates");
            CHECK(std::abs(count - law.expected()) < 6 * law.sd());
        }
    }
    std::fflush(stdout);
}
