#include "emitters.h"

#include "fail.h"
#include "textures.h"

#include <koksma/scene/load.h>

#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>

#include <cmath>

namespace koksma::loader {
namespace {

const std::vector<std::string> kTypes{"area", "point", "constant", "envmap"};

PointLight read_point(Properties& p) {
    PointLight light;
    light.where = p.where();
    if (p.has("position") && p.has("to_world")) fail(p.where("to_world"), "a point light takes 'position' or 'to_world', not both");
    light.position = p.point("position", light.position);
    light.position += glm::dvec3(p.transform("to_world")[3]);
    light.intensity = read_constant(p, "intensity", light.intensity, ColorUse::emission);
    return light;
}

MapEnvironment read_map(Properties& p, Context& context) {
    MapEnvironment map;
    map.where = p.where();
    const std::string name = p.required_text("filename");
    const double scale = p.number("scale", 1.0);
    if (!(scale >= 0.0)) fail(p.where("scale"), "'scale' is {}; it must not be negative", scale);
    map.scale = static_cast<float>(scale);
    map.to_world = p.transform("to_world");
    if (!(std::abs(glm::determinant(glm::dmat3(map.to_world))) > 0.0))
        fail(p.where("to_world"), "'to_world' of the envmap cannot be inverted");
    map.image = shared_image(name, false, p.where("filename"), context);
    for (const Rgb& texel : map.image->texels)
        if (!std::isfinite(texel.r * map.scale) || !std::isfinite(texel.g * map.scale) || !std::isfinite(texel.b * map.scale))
            fail(p.where("scale"), "'scale' {} makes {} infinite", scale, name);
    return map;
}

void set_environment(Environment environment, const Properties& p, Context& context) {
    if (context.scene.environment) {
        const auto& first = std::visit([](const auto& e) -> const SourceLocation& { return e.where; }, *context.scene.environment);
        fail(p.where(), "a scene takes one environment (constant or envmap); the first is at {}", first.text());
    }
    context.scene.environment = std::move(environment);
}

}  // namespace

AreaEmission read_area_emission(const Element& emitter, Context& context) {
    Properties p(emitter, context.ids, kTypes);
    if (p.type() != "area") fail(p.where(), "emitter '{}' cannot be inside a shape; supported there: area", p.type());
    if (!context.attached_emitters.insert(&emitter).second)
        fail(p.where(), "this area emitter is attached to two shapes; each shape needs its own, as in Mitsuba");
    AreaEmission emission;
    emission.where = p.where();
    emission.radiance = read_texture(p, "radiance", Rgb(1.0f), ColorUse::emission, context);
    p.finish();
    return emission;
}

void read_emitter(const Element& emitter, Context& context) {
    Properties p(emitter, context.ids, kTypes);
    if (p.type() == "area") return;  // belongs to the shape that refers to it; load_scene() looks for strays
    if (p.type() == "point") {
        context.scene.point_lights.push_back(read_point(p));
    } else if (p.type() == "constant") {
        const Rgb radiance = read_constant(p, "radiance", Rgb(1.0f), ColorUse::emission);
        set_environment(ConstantEnvironment{radiance, p.where()}, p, context);
    } else {
        set_environment(read_map(p, context), p, context);
    }
    p.finish();
}

}  // namespace koksma::loader
