#include "media.h"

#include "fail.h"
#include "spectra.h"

#include <koksma/scene/load.h>

#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>

#include <algorithm>
#include <cmath>

namespace koksma::loader {
namespace {

glm::dmat4 read_placement(Properties& p) {
    const glm::dmat4 m = p.transform("to_world");
    const double det = glm::determinant(glm::dmat3(m));
    if (det == 0.0 || !std::isfinite(1.0 / det)) fail(p.where("to_world"), "'to_world' of a volume cannot be inverted");
    return m;
}

std::shared_ptr<const VolumeGrid> shared_grid(const std::string& name, const SourceLocation& where, Context& context) {
    const auto file = resolve(name, context.search, where);
    auto& grid = context.grids[file.string()];
    if (grid) return grid;
    try {
        return grid = std::make_shared<const VolumeGrid>(load_vol(file));
    } catch (const Error& e) {
        fail(where, "{}", e.what());
    }
}

GridVolume parse_grid(Properties& p, Context& context) {
    GridVolume v;
    v.grid = shared_grid(p.required_text("filename"), p.where("filename"), context);
    v.filter = p.choice("filter_type", "trilinear", {"trilinear", "nearest"}) == "nearest" ? GridVolume::Filter::nearest
                                                                                           : GridVolume::Filter::trilinear;
    const std::string wrap = p.choice("wrap_mode", "clamp", {"clamp", "repeat", "mirror"});
    v.wrap = wrap == "repeat" ? GridVolume::Wrap::repeat : wrap == "mirror" ? GridVolume::Wrap::mirror : GridVolume::Wrap::clamp;
    (void)p.boolean("raw", false), (void)p.boolean("accel", true);  // without effect on RGB
    v.to_world = read_placement(p);
    if (p.boolean("use_grid_bbox", false)) {
        const glm::dvec3 low(v.grid->low), extent = glm::dvec3(v.grid->high) - low;
        if (!(extent.x > 0.0 && extent.y > 0.0 && extent.z > 0.0))
            fail(p.where("use_grid_bbox"), "the box that the volume's file names is empty");
        v.to_world = v.to_world * glm::dmat4(glm::dvec4(extent.x, 0, 0, 0), glm::dvec4(0, extent.y, 0, 0), glm::dvec4(0, 0, extent.z, 0),
                                             glm::dvec4(low, 1));
    }
    const float largest = *std::max_element(v.grid->values.begin(), v.grid->values.end());
    if (const double max_value = p.number("max_value", largest); !(max_value >= static_cast<double>(largest)))
        fail(p.where("max_value"), "'max_value' is {}, but the file holds {}", max_value, largest);
    return v;
}

/// @param use  reflectance: an albedo in [0, 1]; index: an extinction, not negative
Volume parse_volume(const Element& element, const std::string& name, ColorUse use, Context& context) {
    if (element.tag != "volume") return ConstantVolume{parse_color(element, use), glm::dmat4(1.0)};
    Properties p(element, context.ids, {"gridvolume", "constvolume"});
    if (p.type() == "constvolume") {
        const Element* value = p.value("value");
        const Rgb constant = value ? parse_color(*value, use) : Rgb(1.0f);
        const glm::dmat4 to_world = read_placement(p);
        p.finish();
        return ConstantVolume{constant, to_world};
    }
    GridVolume v = parse_grid(p, context);
    p.finish();
    const auto [low, high] = std::minmax_element(v.grid->values.begin(), v.grid->values.end());
    if (use != ColorUse::any && !(*low >= 0.0f)) fail(p.where("filename"), "the file holds {}; '{}' must not be negative", *low, name);
    if (use == ColorUse::reflectance && !(*high <= 1.0f))
        fail(p.where("filename"), "the file holds {}; '{}' must be in [0, 1]", *high, name);
    return v;
}

Volume read_volume(Properties& p, const std::string& name, const Rgb& default_value, ColorUse use, Context& context) {
    const Element* value = p.field(name);
    return value ? parse_volume(*value, name, use, context) : ConstantVolume{default_value, glm::dmat4(1.0)};
}

double read_phase(const Element& phase, Context& context) {
    Properties p(phase, context.ids, {"isotropic", "hg"});
    double g = 0.0;
    if (p.type() == "hg") {
        g = p.number("g", 0.8);
        if (!(std::abs(static_cast<float>(g)) < 1.0f)) fail(p.where("g"), "'g' is {}; it must be in (-1, 1)", g);
    }
    p.finish();
    return g;
}

Medium parse_medium(const Element& element, Context& context) {
    Properties p(element, context.ids, {"homogeneous", "heterogeneous"});
    Medium m;
    m.where = p.where();
    m.heterogeneous = p.type() == "heterogeneous";
    m.albedo = read_volume(p, "albedo", Rgb(0.75f), ColorUse::reflectance, context);
    m.sigma_t = read_volume(p, "sigma_t", Rgb(1.0f), ColorUse::index, context);
    if (!m.heterogeneous && std::holds_alternative<GridVolume>(m.sigma_t))
        fail(p.where("sigma_t"), "'sigma_t' of a homogeneous medium must be constant; a heterogeneous one takes a gridvolume");
    m.scale = p.number("scale", 1.0);
    if (!(m.scale >= 0.0)) fail(p.where("scale"), "'scale' is {}; it must not be negative", m.scale);
    m.sample_emitters = p.boolean("sample_emitters", true);
    (void)p.boolean("has_spectral_extinction", true);  // a hint, which is not needed
    if (const Element* phase = p.object("phase")) m.g = read_phase(*phase, context);
    p.finish();
    return m;
}

}  // namespace

void check_medium_object(const Element& element, Context& context) {
    if (element.tag == "medium" && !context.media.contains(&element)) (void)parse_medium(element, context);
    if (element.tag == "phase") (void)read_phase(element, context);
    if (element.tag == "volume") (void)parse_volume(element, "value", ColorUse::any, context);
}

std::uint32_t medium_of(const Element& medium, Context& context) {
    if (const auto it = context.media.find(&medium); it != context.media.end()) return it->second;
    Medium m = parse_medium(medium, context);
    const auto index = static_cast<std::uint32_t>(context.scene.media.size());
    context.scene.media.push_back(std::move(m));
    return context.media[&medium] = index;
}

}  // namespace koksma::loader
