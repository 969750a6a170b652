#include "prediction.h"

#include "json_keys.h"

#include <cmath>

namespace koksma {

namespace {

using Json = nlohmann::ordered_json;

Json finite_or_null(double x) { return std::isfinite(x) ? Json(x) : Json(); }

double bound_of(const nlohmann::json& json, double none, const std::string& where) {
    if (json.is_null()) return none;
    if (!json.is_number()) throw Error(fmt::format("{}: expected a number or null, found {}", where, json.dump()));
    return json.get<double>();
}

void read_range(const nlohmann::json& json, const std::string& where, Prediction& p) {
    if (!json.is_array() || json.size() != 2) throw Error(fmt::format("{}: expected [least, most], found {}", where, json.dump()));
    p.least = bound_of(json[0], p.least, where);
    p.most = bound_of(json[1], p.most, where);
    if (!(p.least < p.most) || (std::isinf(p.least) && std::isinf(p.most)))
        throw Error(fmt::format("{}: expected [least, most] with a bound and least below most, found {}", where, json.dump()));
}

}  // namespace

Prediction prediction_of(const nlohmann::json& json, const std::string& where) {
    Prediction p;
    Keys keys(json, where);
    keys.read("samplers", p.samplers, false);
    keys.read("spp", p.spp, false);
    const nlohmann::json *slope = keys.object("slope"), *gain = keys.object("gain");
    std::vector<std::string> order;
    keys.read("order", order, false);
    keys.done();
    if ((slope != nullptr) + (gain != nullptr) + !order.empty() != 1)
        throw Error(where + ": expected one of the keys \"slope\", \"gain\", \"order\"");
    if (slope != nullptr) read_range(*slope, where + ": \"slope\"", p);
    if (gain != nullptr) read_range(*gain, where + ": \"gain\"", p);
    if (!order.empty()) {
        if (order.size() < 2 || !p.samplers.empty()) throw Error(where + ": \"order\": expected two samplers or more, and no \"samplers\"");
        p.samplers = order;
        p.least = 1;
    }
    p.of = slope != nullptr ? Prediction::Of::slope : (gain != nullptr ? Prediction::Of::gain : Prediction::Of::order);
    if ((p.of == Prediction::Of::slope) == (p.spp != 0))
        throw Error(where + ": \"spp\": a gain or an order is at one number of samples, a slope is not");
    return p;
}

Json predictions_json(const std::vector<Prediction>& predictions, const std::function<std::string(const std::string&)>& full_name) {
    Json out = Json::array();
    for (const Prediction& p : predictions) {
        Json samplers = Json::array();
        for (const std::string& s : p.samplers) samplers.push_back(full_name(s));
        const char* of = p.of == Prediction::Of::slope ? "slope" : (p.of == Prediction::Of::gain ? "gain" : "order");
        out.push_back({{"of", of},
                       {"samplers", samplers},
                       {"spp", p.spp > 0 ? Json(p.spp) : Json()},
                       {"least", finite_or_null(p.least)},
                       {"most", finite_or_null(p.most)}});
    }
    return out;
}

}  // namespace koksma
