#include "sheet.h"

#include "../curve.h"
#include "../png.h"

#include <koksma/measure/rmse_estimate.h>

#include <fmt/format.h>

#include <cmath>

namespace koksma::lecture {

Json mean_of(const std::vector<double>& replicates) {
    const Estimate e = mean_estimate(replicates, kConfidence);
    return interval_json(e.value, e.lo, e.hi);
}
Json error_of(const std::vector<double>& squared_errors) {
    const Estimate e = metric_estimate(squared_errors, kConfidence);
    return interval_json(e.value, e.lo, e.hi);
}
Json root_of(const std::vector<double>& squared_errors) {
    const Estimate e = rmse_estimate(squared_errors, kConfidence).rmse;
    return interval_json(e.value, e.lo, e.hi);
}
Json times(Json cell, double factor) {
    for (const char* key : {"value", "lo", "hi"})
        if (!cell[key].is_null()) cell[key] = factor * cell[key].get<double>();
    return cell;
}
Json gain_of(const std::vector<double>& better, const std::vector<double>& baseline, double factor) {
    const Gain g = gain(better, baseline, kConfidence);
    return interval_json(factor * g.value, factor * g.lo, factor * g.hi);
}
Json exactly(double value) { return {{"value", number(value)}, {"lo", nullptr}, {"hi", nullptr}}; }

void Sheet::picture(const std::string& caption, const Image& image, int width, int height, float exposure) {
    const std::string file = fmt::format("pictures/{}-{}.png", topic_, json_["pictures"].size());
    write_png(lab_.out / file, image, width, height, exposure > 0.0f ? exposure : exposure_for(image));
    json_["pictures"].push_back({{"file", file}, {"caption", caption}, {"width", width}});
}

void Sheet::check(const std::string& what, const std::vector<double>& measured, double expected, double rounding, double allowed) {
    const Moments m = moments(measured);
    const double noise = m.n < 2 ? 0.0 : student_t_factor(0.9999, m.n - 1) * std::sqrt(m.variance / m.n);
    json_["checks"].push_back({{"what", what},
                               {"measured", measured.size() < 2 ? exactly(m.mean) : mean_of(measured)},
                               {"expected", expected},
                               {"held", std::fabs(m.mean - expected) <= noise + rounding * std::fabs(expected) + allowed}});
}

}  // namespace koksma::lecture
