#pragma once
// The bands that measured rates must lie in: bands.tsv, and how wide they are.

#include <koksma/rates/rates.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <utility>

namespace koksma::convergence {

/// One row of bands.tsv.
struct Band {
    std::string sampler, integrand;
    int dimensions = 0;
    double slope_6_12 = 0, sd_6_12 = 0, slope_6_14 = 0, sd_6_14 = 0;
    double level = 0, level_sd = 0, kurtosis = 0;  ///< of log2 RMSE at N = 1024

    /// Half the width of the level's band for 256 replicates: six standard deviations of the difference of two measurements,
    /// and at least .15 for errors of bounded distribution (shifts), .55 for others.
    [[nodiscard]] double level_width() const { return std::max(kurtosis < 2.6 ? 0.15 : 0.55, 6 * std::numbers::sqrt2 * level_sd); }
};

/// Half the width of a slope's band.
/// @param spread  standard deviation of our fit over that of the table's
[[nodiscard]] inline double slope_width(double sd, double spread) { return std::max(0.05, 6 * std::sqrt(1 + spread * spread) * sd); }

/// @throws std::runtime_error if the file cannot be read or a row is not understood
[[nodiscard]] inline std::vector<Band> load_bands(const std::string& path) {
    std::ifstream file(path);
    if (!file) throw std::runtime_error("cannot read " + path);
    std::vector<Band> bands;
    bool header = true;
    for (std::string line; std::getline(file, line);) {
        if (line.empty() || line.front() == '#') continue;
        if (std::exchange(header, false)) continue;
        std::istringstream row(line);
        Band b;
        row >> b.sampler >> b.integrand >> b.dimensions >> b.slope_6_12 >> b.sd_6_12 >> b.slope_6_14 >> b.sd_6_14 >> b.level >> b.level_sd >>
            b.kurtosis;
        if (!row) throw std::runtime_error(path + ": not understood: " + line);
        bands.push_back(b);
    }
    return bands;
}

}  // namespace koksma::convergence
