#include "emitters.h"

#include "fail.h"
#include "sensor.h"
#include "textures.h"

#include <koksma/scene/load.h>

#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>

#include <cmath>

namespace koksma::loader {
namespace {

const std::vector<std::string> kTypes{"area", "point", "spot", "directional", "projector", "constant", "envmap"};

PointLight read_point(Properties& p) {
    PointLight light;
    light.where = p.where();
    if (p.has("position") && p.has("to_world")) fail(p.where("to_world"), "a point light takes 'position' or 'to_world', not both");
    light.position = p.point("position", light.position);
    light.position += glm::dvec3(p.transform("to_world")[3]);
    light.intensity = read_constant(p, "intensity", light.intensity, ColorUse::emission);
    return light;
}

void check_invertible(const Properties& p, const glm::dmat4& m) {
    const double det = glm::determinant(glm::dmat3(m));
    if (det == 0.0 || !std::isfinite(1.0 / det)) fail(p.where("to_world"), "'to_world' of the {} cannot be inverted", p.type());
}

SpotLight read_spot(Properties& p, Context& context) {
    SpotLight light;
    light.where = p.where();
    light.to_world = p.transform("to_world");
    check_invertible(p, light.to_world);
    light.intensity = read_constant(p, "intensity", light.intensity, ColorUse::emission);
    light.cutoff_degrees = p.number("cutoff_angle", light.cutoff_degrees);
    if (!(light.cutoff_degrees > 0.0 && light.cutoff_degrees <= 180.0))
        fail(p.where("cutoff_angle"), "'cutoff_angle' is {} degrees; it must be in (0, 180]", light.cutoff_degrees);
    light.beam_degrees = p.number("beam_width", 0.75 * light.cutoff_degrees);
    if (!(light.beam_degrees >= 0.0 && light.beam_degrees <= light.cutoff_degrees))
        fail(p.where("beam_width"), "'beam_width' is {} degrees; it must be in [0, cutoff_angle = {}]", light.beam_degrees, light.cutoff_degrees);
    if (p.has("texture")) {
        light.texture = read_texture(p, "texture", Rgb(1.0f), ColorUse::emission, context);
        if (std::holds_alternative<Rgb>(*light.texture)) fail(p.where("texture"), "'texture' of a spot must vary (a bitmap or a checkerboard), as in Mitsuba");
        if (!(light.cutoff_degrees < 90.0)) fail(p.where("texture"), "a spot with a texture needs a 'cutoff_angle' below 90 degrees");
    } else {
        (void)p.value("texture");
    }
    return light;
}

DirectionalLight read_directional(Properties& p) {
    DirectionalLight light;
    light.where = p.where();
    if (p.has("direction") && p.has("to_world")) fail(p.where("to_world"), "a directional light takes 'direction' or 'to_world', not both");
    light.direction = p.point("direction", light.direction);
    const glm::dmat4 to_world = p.transform("to_world");
    if (p.has("to_world")) light.direction = glm::dvec3(to_world[2]);
    const double len2 = glm::dot(light.direction, light.direction);
    if (!(len2 > 0.0) || !std::isfinite(len2)) fail(p.where("direction"), "the direction of the light has no length");
    if (p.has("to_world") && std::abs(len2 - 1.0) > 1e-3)
        fail(p.where("to_world"), "'to_world' of a directional light must not scale; give the 'direction'");
    light.irradiance = read_constant(p, "irradiance", light.irradiance, ColorUse::emission);
    return light;
}

ProjectorLight read_projector(Properties& p, Context& context) {
    ProjectorLight light;
    light.where = p.where();
    light.to_world = p.transform("to_world");
    check_frame(light.to_world, "a projector", p.where("to_world"));
    light.irradiance = read_texture(p, "irradiance", Rgb(1.0f), ColorUse::emission, context);
    light.scale = p.number("scale", light.scale);
    if (!(light.scale >= 0.0)) fail(p.where("scale"), "'scale' is {}; it must not be negative", light.scale);
    if (const auto* bitmap = std::get_if<BitmapTexture>(&light.irradiance)) light.aspect = double(bitmap->image->width) / double(bitmap->image->height);
    light.fov_x_degrees = read_fov(p, light.aspect);
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
    } else if (p.type() == "spot") {
        context.scene.delta_lights.emplace_back(read_spot(p, context));
    } else if (p.type() == "directional") {
        context.scene.delta_lights.emplace_back(read_directional(p));
    } else if (p.type() == "projector") {
        context.scene.delta_lights.emplace_back(read_projector(p, context));
    } else if (p.type() == "constant") {
        const Rgb radiance = read_constant(p, "radiance", Rgb(1.0f), ColorUse::emission);
        set_environment(ConstantEnvironment{radiance, p.where()}, p, context);
    } else {
        set_environment(read_map(p, context), p, context);
    }
    p.finish();
}

}  // namespace koksma::loader
