#include <koksma/sampling/error.h>

#include "compile.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include <algorithm>
#include <cmath>
#include <string>

namespace koksma::detail {

namespace {

/// Steps of tracking through a medium, in the mean. Beyond this a render would seem to stand still.
constexpr double kMostSteps = 1e6;

void check(const Medium& m) {
    const auto bad = [&](const std::string& what) { throw Error(m.where.text() + ": " + what); };
    const Vec3f sigma = largest_value(m.sigma_t), albedo = largest_value(m.albedo);
    const double largest = m.scale * max_component(sigma);
    if (!(m.scale >= 0.0) || !(std::min({sigma.x, sigma.y, sigma.z}) >= 0.0f) || !std::isfinite(static_cast<float>(largest)))
        bad("the extinction of a medium must be finite and not negative");
    if (!(std::min({albedo.x, albedo.y, albedo.z}) >= 0.0f && max_component(albedo) <= 1.0f))
        bad("the albedo of a medium must be in [0, 1]");
    if (!(std::fabs(m.g) < 1.0)) bad("g of a medium is " + std::to_string(m.g) + "; it must be in (-1, 1)");
    if (!m.heterogeneous && std::holds_alternative<GridVolume>(m.sigma_t)) bad("the extinction of a homogeneous medium must be constant");
}

const glm::dmat4& to_world_of(const Volume& volume) {
    return std::visit([](const auto& v) -> const glm::dmat4& { return v.to_world; }, volume);
}

VolumeField field_of(const Volume& volume, glm::dvec3 origin, const SourceLocation& where) {
    VolumeField out;
    if (const auto* constant = std::get_if<ConstantVolume>(&volume)) {
        out.constant = constant->value;
        return out;
    }
    const auto& grid = std::get<GridVolume>(volume);
    const double det = glm::determinant(glm::dmat3(grid.to_world));
    if (!(det != 0.0) || !std::isfinite(1.0 / det)) throw Error(where.text() + ": the to_world of a volume is singular");
    const glm::dmat4 own = glm::inverse(grid.to_world);
    const glm::dmat3 rows = glm::transpose(glm::dmat3(own));
    for (int i = 0; i < 3; ++i) out.rows[i] = Vec3f(glm::vec3(rows[i]));
    out.offset = Vec3f(glm::vec3(glm::dvec3(own * glm::dvec4(origin, 1.0))));
    out.grid = grid.grid;
    out.nearest = grid.filter == GridVolume::Filter::nearest;
    out.wrap = grid.wrap;
    return out;
}

/// The box around the image of the unit cube, which is where Mitsuba's heterogeneous media end.
void bound(const Volume& volume, glm::dvec3 origin, MediumRecord& out) {
    glm::dvec3 low(std::numeric_limits<double>::infinity()), high = -low;
    for (int corner = 0; corner < 8; ++corner) {
        const glm::dvec4 own(corner & 1, (corner >> 1) & 1, corner >> 2, 1.0);
        const glm::dvec3 p = glm::dvec3(to_world_of(volume) * own) - origin;
        low = glm::min(low, p), high = glm::max(high, p);
    }
    out.low = Vec3f(glm::vec3(low));
    out.high = Vec3f(glm::vec3(high));
}

MediumRecord compile_medium(const Medium& m, glm::dvec3 origin) {
    check(m);
    MediumRecord out;
    out.heterogeneous = m.heterogeneous;
    out.sample_emitters = m.sample_emitters;
    out.g = static_cast<float>(m.g);
    out.scale = static_cast<float>(m.scale);
    out.albedo = field_of(m.albedo, origin, m.where);
    if (!m.heterogeneous) {
        out.sigma_t = Vec3f(std::get<ConstantVolume>(m.sigma_t).value) * out.scale;
        out.grey = out.sigma_t.x == out.sigma_t.y && out.sigma_t.x == out.sigma_t.z;
        return out;
    }
    out.density = field_of(m.sigma_t, origin, m.where);
    out.majorant = out.scale * max_component(largest_value(m.sigma_t));
    bound(m.sigma_t, origin, out);
    if (!(double{out.majorant} * length(out.high - out.low) <= kMostSteps))
        throw Error(m.where.text() + ": the medium is " + std::to_string(double{out.majorant} * length(out.high - out.low)) +
                    " mean free paths thick where it is densest; at most 1e6 are tracked");
    return out;
}

bool is_empty(const MediumRecord& m) { return m.heterogeneous ? !(m.majorant > 0.0f) : !(max_component(m.sigma_t) > 0.0f); }

}  // namespace

void compile_media(Scene& scene, glm::dvec3 origin) {
    const SceneDescription& d = scene.description;
    std::vector<std::int32_t> records(d.media.size(), -1);
    // A medium that nothing refers to is no part of the scene; an empty one is a vacuum.
    const auto record = [&](std::optional<std::uint32_t> medium) -> std::int32_t {
        if (!medium) return -1;
        const Medium& m = d.media.at(*medium);
        if (records[*medium] >= 0) return records[*medium];
        MediumRecord compiled = compile_medium(m, origin);
        if (is_empty(compiled)) return -1;
        scene.call_for(m.heterogeneous ? EffectSet{Effect::medium, Effect::heterogeneous} : EffectSet{Effect::medium}, m.where);
        scene.media.push_back(std::move(compiled));
        return records[*medium] = static_cast<std::int32_t>(scene.media.size() - 1);
    };
    scene.camera_medium = record(d.camera.medium);
    for (std::uint32_t i = 0; i < scene.geometries.size(); ++i) {
        const Shape& s = shape_of(d, i);
        scene.boundaries.push_back({s.interior.has_value() || s.exterior.has_value(), record(s.interior), record(s.exterior)});
    }
    if (scene.media.empty())
        scene.boundaries.clear();
    else
        scene.boundaries.resize(scene.geometries.size());
}

}  // namespace koksma::detail
