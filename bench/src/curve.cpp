#include "curve.h"

#include <algorithm>
#include <cmath>

namespace koksma {

using Json = nlohmann::ordered_json;

Curve curve_of(const std::vector<Row>& rows, const std::string& scene, const std::string& sampler, int layout, bool prefixes) {
    Curve curve;
    for (const Row& r : rows) {
        if (r.scene != scene || r.sampler != sampler || r.layout != layout || (r.prefix_of > 0) != prefixes) continue;
        Point& p = curve[r.spp];
        p.spp = r.spp;
        p.all.push_back(r.all);
        p.masked.push_back(r.masked);
        p.mse.push_back(r.all.mse);
        p.relmse.push_back(r.all.relmse);
        p.wall.push_back(r.wall_seconds);
        p.cpu.push_back(r.cpu_seconds);
        p.sampler.push_back(r.sampler_seconds);
        p.invalid += r.invalid_samples;
        p.paths = r.paths;
        if (std::find(p.fills.begin(), p.fills.end(), r.fill) == p.fills.end()) p.fills.push_back(r.fill);
    }
    return curve;
}

std::vector<double> values_of(const std::vector<Errors>& errors, double Errors::*which) {
    std::vector<double> out;
    for (const Errors& e : errors)
        if (std::isfinite(e.*which)) out.push_back(e.*which);
    return out;
}

std::vector<double> replicates(const std::vector<double>& values, bool randomized) {
    return randomized || values.empty() ? values : std::vector<double>(values.begin(), values.begin() + 1);
}

Json number(double x) { return std::isfinite(x) ? Json(x) : Json(); }

Json interval_json(double value, double lo, double hi) { return {{"value", number(value)}, {"lo", number(lo)}, {"hi", number(hi)}}; }

}  // namespace koksma
