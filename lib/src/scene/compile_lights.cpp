#include <koksma/sampling/error.h>

#include "compile.h"
#include "mesh_forms.h"

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include <cmath>
#include <numbers>

namespace koksma::detail {

namespace {

constexpr double kPiDouble = std::numbers::pi;

double mean_luminance(const Texture& t) { return luminance(mean(t)); }

/// A scene made by hand may hold what the loader refuses; a NaN would be lost in the kernels' comparisons, and the light be black.
void check_radiance(const Rgb& c, const SourceLocation& where) {
    for (int i = 0; i < 3; ++i)
        if (!(c[i] >= 0.0f) || !std::isfinite(c[i]))
            throw Error(where.text() + ": radiance or intensity is " + std::to_string(c[i]) + "; it must be finite and not negative");
}
void check_radiance(const Image& image, const SourceLocation& where) {
    for (const Rgb& texel : image.texels) check_radiance(texel, where);
}
void check_radiance(const Texture& t, const SourceLocation& where) {
    if (const auto* constant = std::get_if<Rgb>(&t)) check_radiance(*constant, where);
    if (const auto* bitmap = std::get_if<BitmapTexture>(&t)) check_radiance(*bitmap->image, where);
    if (const auto* checks = std::get_if<CheckerboardTexture>(&t)) check_radiance(checks->color0, where), check_radiance(checks->color1, where);
    if (std::holds_alternative<MeshAttributeTexture>(t)) throw Error(where.text() + ": light that varies with a mesh attribute is not supported");
}

/// Twice the area times the normal, in double.
Vec3d area_vector(const Scene& scene, const std::array<std::uint32_t, 3>& t) {
    const Vec3d v0 = to_double(scene.positions[t[0]]);
    return cross(to_double(scene.positions[t[1]]) - v0, to_double(scene.positions[t[2]]) - v0);
}

std::size_t triangle_end(const Scene& scene, std::size_t geometry) {
    for (std::size_t j = geometry + 1; j < scene.geometries.size(); ++j)
        if (scene.geometries[j].kind == GeometryKind::mesh) return scene.geometries[j].first;
    return scene.triangles.size();
}

/// Kind, area and sampling data of a surface that emits. @return its area in m^2
double make_surface_light(const Scene& scene, const Shape& shape, std::size_t geometry, Light& light) {
    const GeometryRecord& g = scene.geometries[geometry];
    if (g.kind == GeometryKind::sphere) {
        light.kind = LightKind::sphere;
        const double r = scene.spheres[g.first].radius;
        return 4.0 * kPiDouble * r * r;
    }
    if (g.kind == GeometryKind::cylinder) {
        light.kind = LightKind::cylinder;
        const AnalyticCylinder& c = scene.cylinders[g.first];
        return 2.0 * kPiDouble * c.radius * length(c.axis);
    }
    if (g.kind == GeometryKind::disk) {
        light.kind = LightKind::disk;
        const AnalyticDisk& disk = scene.disks[g.first];
        const double across = length(cross(disk.s, disk.t));
        // An ellipse is sampled uniformly only up to its shear: x, y are uniform, so is the image under an affine map.
        return kPiDouble * across;
    }
    std::vector<double> areas;
    double area = 0.0;
    for (std::size_t t = g.first; t < triangle_end(scene, geometry); ++t) {
        areas.push_back(0.5 * length(area_vector(scene, scene.triangles[t])));
        area += areas.back();
    }
    if (std::holds_alternative<RectangleShape>(shape.geometry)) {
        const Vec3d n = area_vector(scene, scene.triangles[g.first]);
        const Vec3d m = area_vector(scene, scene.triangles[g.first + 1]);
        // Affine images of a square are parallelograms: both halves have one area.
        if (std::fabs(length(n) - length(m)) <= 1e-3 * length(n)) {
            light.kind = LightKind::parallelogram;
            // The true area: float moves the corners of a small light by a part of its size, 1.3 % of the area at 2 um and 1 m.
            return area > 0.0 ? 4.0 * glm::length(glm::cross(glm::dvec3(shape.to_world[0]), glm::dvec3(shape.to_world[1]))) : area;
        }
    }
    std::vector<TriangleIndices> triangles(scene.triangles.begin() + g.first, scene.triangles.begin() + static_cast<std::ptrdiff_t>(triangle_end(scene, geometry)));
    if (make_parallelogram(scene.positions, triangles)) {
        light.kind = LightKind::parallelogram;
        return area;
    }
    light.kind = LightKind::mesh;
    light.triangles = DiscreteDistribution(areas);
    return area;
}

/// Lights, of meshes triangles, from which on a tree chooses (docs/design.md, "Many lights", has the measurement).
constexpr std::size_t kManyLights = 16;

/// Share of the lights at infinity where there are others beside them.
constexpr float kDistantShare = 0.5f;

bool is_distant(const Light& light) { return light.kind == LightKind::environment || light.kind == LightKind::directional; }

/// What lights at infinity give grows with the ball around the scene, most of which may be empty. Their powers are scaled to their share, so
/// that neither kind is starved: no kind has more than twice the variance that it would have alone.
std::vector<double> shared_out(const Scene& scene, std::vector<double> powers) {
    double distant = 0.0, near = 0.0;
    for (std::size_t i = 0; i < powers.size(); ++i) (is_distant(scene.lights[i]) ? distant : near) += powers[i];
    if (!(distant > 0.0 && near > 0.0)) return powers;
    for (std::size_t i = 0; i < powers.size(); ++i)
        powers[i] *= is_distant(scene.lights[i]) ? double{kDistantShare} / distant : (1.0 - double{kDistantShare}) / near;
    return powers;
}

void compile_light_tree(Scene& scene, std::span<const double> radiances, std::span<const double> powers) {
    const std::vector<LightLeaf> leaves = light_leaves(scene, radiances);
    if (leaves.size() < kManyLights) return;
    scene.light_tree = build_light_tree(leaves, scene.lights.size());
    double sum = 0.0;
    for (std::size_t i = 0; i < scene.lights.size(); ++i)
        if (is_distant(scene.lights[i])) sum += powers[i];
    for (std::size_t i = 0; i < scene.lights.size(); ++i)
        if (is_distant(scene.lights[i]) && powers[i] > 0.0) scene.light_tree.distant.push_back({static_cast<std::uint32_t>(i), static_cast<float>(powers[i] / sum)});
    if (sum > 0.0) scene.light_tree.distant_share = kDistantShare;
    scene.effects |= {Effect::light_choice, Effect::many_lights};
}

constexpr double kDegree = kPiDouble / 180.0;

struct DeltaLightCompiler {
    Scene& scene;
    glm::dvec3 origin;
    Light light{};
    double power = 0.0, radiance = 0.0;  ///< luminances: W, and W/sr where it shines

    /// Position and frame. Rows of the inverse's linear part see a direction in the light's own space.
    Beam beam(const glm::dmat4& to_world, const SourceLocation& where) {
        const glm::dmat3 linear(to_world);
        const double det = glm::determinant(linear);
        if (!(det != 0.0) || !std::isfinite(1.0 / det)) throw Error(where.text() + ": the light's to_world is singular");
        const glm::dmat3 rows = glm::transpose(glm::inverse(linear));
        Beam b;
        b.right = Vec3f(glm::vec3(rows[0]));
        b.up = Vec3f(glm::vec3(rows[1]));
        b.forward = Vec3f(glm::vec3(rows[2]));
        b.axis = Vec3f(glm::vec3(glm::normalize(linear[2])));
        light.corner = Vec3f(glm::vec3(glm::dvec3(to_world[3]) - origin));
        light.geometry = static_cast<std::uint32_t>(scene.beams.size());
        return b;
    }
    void operator()(const SpotLight& s) {
        check_radiance(s.intensity, s.where);
        if (!(s.cutoff_degrees > 0.0 && s.cutoff_degrees <= 180.0 && s.beam_degrees >= 0.0 && s.beam_degrees <= s.cutoff_degrees))
            throw Error(s.where.text() + ": a spot's cutoff must be in (0, 180] degrees and its beam in [0, cutoff]");
        light.kind = LightKind::spot;
        Beam b = beam(s.to_world, s.where);
        const double cutoff = s.cutoff_degrees * kDegree, width = s.beam_degrees * kDegree;
        b.cutoff = static_cast<float>(cutoff);
        b.cos_cutoff = static_cast<float>(std::cos(cutoff));
        b.cos_beam = static_cast<float>(std::cos(width));
        b.inverse_transition = cutoff > width ? static_cast<float>(1.0 / (cutoff - width)) : 0.0f;
        b.half_width = b.half_height = static_cast<float>(std::tan(cutoff));
        b.pictured = s.texture.has_value();
        double share = 1.0;
        if (s.texture) {
            check_radiance(*s.texture, s.where);
            light.radiance = texture_ref(scene, *s.texture);
            share = mean_luminance(*s.texture);
            // The factor is the texture's, the intensity the beam's.
            light.edge_u = Vec3f(s.intensity);
        } else {
            light.radiance.constant = s.intensity;
            light.edge_u = Vec3f(1.0f);
        }
        scene.beams.push_back(b);
        radiance = luminance(s.intensity) * share;
        power = 2.0 * kPiDouble * (1.0 - 0.5 * (std::cos(cutoff) + std::cos(width))) * radiance;
    }
    void operator()(const DirectionalLight& d) {
        check_radiance(d.irradiance, d.where);
        const double len = glm::length(d.direction);
        if (!(len > 0.0) || !std::isfinite(len)) throw Error(d.where.text() + ": the direction of a directional light has no length");
        light.kind = LightKind::directional;
        light.corner = Vec3f(glm::vec3(-d.direction / len));
        light.radiance.constant = d.irradiance;
        radiance = luminance(d.irradiance);
        power = kPiDouble * scene.bounding_radius * scene.bounding_radius * radiance;
    }
    void operator()(const ProjectorLight& p) {
        check_radiance(p.irradiance, p.where);
        if (!(p.scale >= 0.0 && std::isfinite(p.scale) && p.fov_x_degrees > 0.0 && p.fov_x_degrees < 180.0 && p.aspect > 0.0))
            throw Error(p.where.text() + ": a projector's scale must be finite and not negative, its angle in (0, 180)");
        light.kind = LightKind::projector;
        Beam b = beam(p.to_world, p.where);
        const double half_width = std::tan(0.5 * p.fov_x_degrees * kDegree);
        b.half_width = static_cast<float>(half_width);
        b.half_height = static_cast<float>(half_width / p.aspect);
        scene.beams.push_back(b);
        light.radiance = texture_ref(scene, p.irradiance);
        light.edge_u = Vec3f(static_cast<float>(kPiDouble * p.scale));
        radiance = kPiDouble * p.scale * mean_luminance(p.irradiance);
        power = radiance * 4.0 * half_width * half_width / p.aspect;
    }
};

}  // namespace

void compile_lights(Scene& scene, glm::dvec3 origin) {
    const SceneDescription& d = scene.description;
    std::vector<double> powers, radiances;

    for (std::size_t i = 0; i < d.shapes.size(); ++i) {
        if (!d.shapes[i].emission) continue;
        const Caller caller(scene, d.shapes[i].emission->where);
        check_radiance(d.shapes[i].emission->radiance, d.shapes[i].emission->where);
        Light light;
        light.geometry = static_cast<std::uint32_t>(i);
        const double area = make_surface_light(scene, d.shapes[i], i, light);
        light.area = static_cast<float>(area);
        // A denormal area is zero to a renderer that flushes denormals.
        if (!(light.area >= 1e-37f) || !std::isfinite(light.area))
            throw Error(d.shapes[i].where.text() + ": a light of area " + std::to_string(area) + " m^2; it must be positive (and at least 1e-37)");
        light.radiance = texture_ref(scene, d.shapes[i].emission->radiance);
        scene.geometries[i].light = static_cast<std::int32_t>(scene.lights.size());
        scene.effects |= {Effect::area_light};
        if (light.kind == LightKind::sphere) scene.effects |= {Effect::sphere_light};
        radiances.push_back(mean_luminance(d.shapes[i].emission->radiance));
        powers.push_back(kPiDouble * area * radiances.back());
        scene.lights.push_back(std::move(light));
    }
    for (const PointLight& p : d.point_lights) {
        const Caller caller(scene, p.where);
        check_radiance(p.intensity, p.where);
        Light light;
        light.kind = LightKind::point;
        light.corner = Vec3f(glm::vec3(p.position - origin));
        light.radiance.constant = p.intensity;
        scene.effects |= {Effect::point_light};
        radiances.push_back(luminance(p.intensity));
        powers.push_back(4.0 * kPiDouble * radiances.back());
        scene.lights.push_back(std::move(light));
    }
    for (const DeltaLight& source : d.delta_lights) {
        DeltaLightCompiler compiler{scene, origin};
        const Caller caller(scene, std::visit([](const auto& s) -> const SourceLocation& { return s.where; }, source));
        std::visit(compiler, source);
        scene.effects |= {Effect::point_light};
        radiances.push_back(compiler.radiance);
        powers.push_back(compiler.power);
        scene.lights.push_back(std::move(compiler.light));
    }
    if (d.environment) {
        const Caller caller(scene, std::visit([](const auto& e) -> const SourceLocation& { return e.where; }, *d.environment));
        Light light;
        light.kind = LightKind::environment;
        if (const auto* map = std::get_if<MapEnvironment>(&*d.environment)) {
            check_radiance(*map->image, map->where);
            scene.environment_map.emplace(*map);
            light.radiance.constant = scene.environment_map->mean_radiance();
        } else {
            const auto& constant = std::get<ConstantEnvironment>(*d.environment);
            check_radiance(constant.radiance, constant.where);
            light.radiance.constant = constant.radiance;
        }
        scene.environment_light = static_cast<std::int32_t>(scene.lights.size());
        scene.effects |= {Effect::environment};
        const double r = scene.bounding_radius;
        radiances.push_back(luminance(light.radiance.constant));
        powers.push_back(4.0 * kPiDouble * kPiDouble * r * r * radiances.back());
        scene.lights.push_back(std::move(light));
    }
    // A light whose luminance is zero in spite of some colour still needs a chance; a black one gets none.
    for (std::size_t i = 0; i < powers.size(); ++i)
        if (!(powers[i] > 0.0) && max_component(scene.lights[i].radiance.constant) > 0.0f) powers[i] = radiances[i] = 1e-30;
    scene.light_choice = DiscreteDistribution(shared_out(scene, powers));
    if (scene.lights.size() > 1) scene.effects |= {Effect::light_choice};
    compile_light_tree(scene, radiances, powers);
}

}  // namespace koksma::detail
