// <integrator type="path">

#include "sensor.h"

#include <limits>

namespace koksma::loader {

void read_integrator(const Element& element, Context& context) {
    Properties p(element, context.ids, {"path"});
    IntegratorSettings& settings = context.scene.integrator;
    constexpr std::int64_t kMax = std::numeric_limits<std::int32_t>::max();
    settings.max_depth = static_cast<std::int32_t>(p.integer("max_depth", settings.max_depth, -1, kMax));
    settings.rr_depth = static_cast<std::int32_t>(p.integer("rr_depth", settings.rr_depth, 1, kMax));
    settings.hide_emitters = p.boolean("hide_emitters", settings.hide_emitters);
    p.finish();
}

}  // namespace koksma::loader
