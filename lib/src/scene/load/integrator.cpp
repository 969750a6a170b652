// <integrator>: path, direct, volpath, volpathmis, and moment around one of them.

#include "fail.h"
#include "sensor.h"

#include <limits>

namespace koksma::loader {
namespace {

constexpr std::int64_t kMax = std::numeric_limits<std::int32_t>::max();

/// Paths of one reflection are the direct light: one sample of a light and one of the BSDF, by the power heuristic, as in Mitsuba, or one
/// of the two.
void read_direct(Properties& p, IntegratorSettings& settings) {
    if (p.has("shading_samples") && (p.has("emitter_samples") || p.has("bsdf_samples")))
        fail(p.where("shading_samples"), "give 'shading_samples', or 'emitter_samples' and 'bsdf_samples', not both");
    const auto count = [&](const char* name, std::int64_t least) {
        const auto n = p.integer(name, 1, 0, kMax);
        if (n < least || n > 1)
            fail(p.where(name), "'{}' is {}; only {} is supported: take more samples per pixel instead", name, n,
                 least == 1 ? "1" : "0 or 1");
        return n;
    };
    count("shading_samples", 1);
    const auto lights = count("emitter_samples", 0), bsdfs = count("bsdf_samples", 0);
    if (lights + bsdfs == 0) fail(p.where("bsdf_samples"), "'emitter_samples' and 'bsdf_samples' are both 0; one of them must be 1");
    settings.technique = lights == 0 ? Technique::bsdf : bsdfs == 0 ? Technique::light : Technique::mis;
    settings.max_depth = 2;
    settings.rr_depth = static_cast<std::int32_t>(kMax);  // no roulette
}

void read_one(const Element& element, Context& context, bool inside_moment) {
    Properties p(element, context.ids, {"path", "direct", "volpath", "volpathmis", "moment"});
    IntegratorSettings& settings = context.scene.integrator;
    if (p.type() == "moment") {
        if (inside_moment) fail(p.where(), "a moment integrator inside another is not supported");
        const Element* nested = p.object("integrator");
        if (!nested) fail(p.where(), "'moment' takes one integrator (path, direct, volpath or volpathmis)");
        p.finish();
        const std::string* name = nested->find("name");
        settings.moments = name ? *name : "_arg_0";  // what Mitsuba calls a child without a name
        return read_one(*nested, context, true);
    }
    if (p.type() == "direct") {
        read_direct(p, settings);
    } else {
        settings.max_depth = static_cast<std::int32_t>(p.integer("max_depth", settings.max_depth, -1, kMax));
        settings.rr_depth = static_cast<std::int32_t>(p.integer("rr_depth", settings.rr_depth, 1, kMax));
    }
    settings.volumetric = p.type() == "volpath" || p.type() == "volpathmis";
    settings.hide_emitters = p.boolean("hide_emitters", settings.hide_emitters);
    p.finish();
}

}  // namespace

void read_integrator(const Element& element, Context& context) { read_one(element, context, false); }

}  // namespace koksma::loader
