// <sampler>: sample count, seed, and the name of one of our samplers.

#include "fail.h"
#include "sensor.h"

#include <algorithm>
#include <array>
#include <limits>

namespace koksma::loader {
namespace {

// Mitsuba's samplers that say nothing to us; the program's own choice is used.
constexpr std::array<std::string_view, 3> kMitsubaOnly{"multijitter", "orthogonal", "ldsampler"};

/// "name:option=value,option=value" from every other parameter, in the order of the file. The registry knows what is allowed.
std::string spec(const std::string& name, Properties& p) {
    std::string text = name;
    for (const Attribute& option : p.remaining_scalars()) {
        const char separator = text.size() == name.size() ? ':' : ',';
        text += separator + option.name + '=' + option.value;
    }
    return text;
}

}  // namespace

void read_sampler(const Element& element, Context& context) {
    Properties p(element, context.ids, {});
    constexpr std::int64_t kMax = std::numeric_limits<std::int64_t>::max();
    context.scene.spp = static_cast<std::uint64_t>(p.integer("sample_count", 4, 1, kMax));
    context.scene.seed = static_cast<std::uint64_t>(p.integer("seed", 0, 0, kMax));
    if (std::find(kMitsubaOnly.begin(), kMitsubaOnly.end(), p.type()) != kMitsubaOnly.end()) {
        p.ignore_rest();
    } else if (p.type() == "independent") {
        context.scene.sampler = "random";
    } else if (p.type() == "stratified" && p.has("jitter")) {
        if (!p.boolean("jitter", true)) fail(p.where("jitter"), "'jitter' must be true: strata without jitter are not supported");
        context.scene.sampler = spec("stratified", p);
    } else {
        context.scene.sampler = spec(p.type(), p);
    }
    p.finish();
}

}  // namespace koksma::loader
