#include "sensor.h"

#include "fail.h"
#include "media.h"
#include "numbers.h"

#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>

#include <cmath>
#include <numbers>

namespace koksma::loader {
namespace {

double radians(double degrees) { return degrees * std::numbers::pi / 180.0; }

/// The horizontal angle of the full film; a crop does not change it. tan(half angle) scales with film width.
double horizontal_fov(double fov_degrees, const std::string& axis, double aspect) {
    double scale = 1.0;  // half width of the film over half length along the axis
    if (axis == "y" || (axis == "smaller" && aspect > 1.0) || (axis == "larger" && aspect <= 1.0)) scale = aspect;
    if (axis == "diagonal") scale = aspect / std::sqrt(1.0 + aspect * aspect);
    if (scale == 1.0) return fov_degrees;
    return 2.0 * std::atan(std::tan(radians(0.5 * fov_degrees)) * scale) * 180.0 / std::numbers::pi;
}

/// "50mm" or "50": of a lens for 36 mm x 24 mm film, whose diagonal is the angle's.
double focal_length_fov(Properties& p, double aspect) {
    const std::string text = p.text("focal_length", "50mm");
    std::string_view number = trimmed(text);
    if (number.ends_with("mm")) number.remove_suffix(2);
    const auto mm = parse_double(number);
    if (!mm || !(*mm > 0.0) || !std::isfinite(*mm))
        fail(p.where("focal_length"), "'{}' is not a focal length; expected, say, \"50mm\"", text);
    const double diagonal_degrees = 2.0 * std::atan(0.5 * std::hypot(36.0, 24.0) / *mm) * 180.0 / std::numbers::pi;
    return horizontal_fov(diagonal_degrees, "diagonal", aspect);
}

void read_clip(Properties& p, Camera& camera) {
    camera.near_clip = p.number("near_clip", camera.near_clip);
    camera.far_clip = p.number("far_clip", camera.far_clip);
    if (!(camera.near_clip > 0.0)) fail(p.where("near_clip"), "'near_clip' is {}; it must be positive", camera.near_clip);
    if (!(camera.far_clip > camera.near_clip))
        fail(p.where("far_clip"), "'far_clip' is {}; it must be beyond near_clip, {}", camera.far_clip, camera.near_clip);
}

void read_lens(Properties& p, Camera& camera) {
    camera.focus_distance = p.number("focus_distance", camera.far_clip);
    if (!(camera.focus_distance > 0.0))
        fail(p.where("focus_distance"), "'focus_distance' is {}; it must be positive", camera.focus_distance);
    if (p.type() == "thinlens") {
        camera.aperture_radius = p.required_number("aperture_radius");
        if (!(camera.aperture_radius >= 0.0))
            fail(p.where("aperture_radius"), "'aperture_radius' is {}; it must not be negative", camera.aperture_radius);
    } else {
        camera.principal_point_offset.x = p.number("principal_point_offset_x", 0.0);
        camera.principal_point_offset.y = p.number("principal_point_offset_y", 0.0);
    }
}

void read_shutter(Properties& p, Camera& camera) {
    camera.shutter_open = p.number("shutter_open", 0.0);
    camera.shutter_close = p.number("shutter_close", 0.0);
    if (!(camera.shutter_close >= camera.shutter_open))
        fail(p.where("shutter_close"), "the shutter closes at {}, before it opens at {}", camera.shutter_close, camera.shutter_open);
}

}  // namespace

double read_fov(Properties& p, double aspect) {
    // Asked for even where it is not given: what was asked for is what an error lists as supported.
    const double fov = p.number("fov", 0.0);
    if (!p.has("fov")) return focal_length_fov(p, aspect);
    if (p.has("focal_length")) fail(p.where("focal_length"), "give 'fov' or 'focal_length', not both");
    const std::string axis = p.choice("fov_axis", "x", {"x", "y", "diagonal", "smaller", "larger"});
    if (!(fov > 0.0 && fov < 180.0)) fail(p.where("fov"), "'fov' is {} degrees; it must be in (0, 180)", fov);
    return horizontal_fov(fov, axis, aspect);
}

void check_frame(const glm::dmat4& m, std::string_view what, const SourceLocation& where) {
    const double tolerance = 1e-3;  // Mitsuba's, on squared lengths
    for (int i = 0; i < 3; ++i) {
        const glm::dvec3 a(m[i]), b(m[(i + 1) % 3]);
        if (!(std::abs(glm::dot(a, a) - 1.0) <= tolerance)) fail(where, "'to_world' of {} must not scale", what);
        if (!(std::abs(glm::dot(a, b)) <= tolerance)) fail(where, "'to_world' of {} must not shear", what);
    }
}

void read_sensor(const Element& element, Context& context) {
    Properties p(element, context.ids, {"perspective", "thinlens", "orthographic"});
    const Element* film = p.object("film");
    if (!film) fail(p.where(), "the sensor needs a <film type=\"hdrfilm\"> ");
    read_film(*film, context);

    Camera& camera = context.scene.camera;
    camera.where = p.where();
    camera.to_world = p.transform("to_world");
    camera.orthographic = p.type() == "orthographic";
    if (camera.orthographic) {
        const double det = glm::determinant(glm::dmat3(camera.to_world));
        if (det == 0.0 || !std::isfinite(1.0 / det)) fail(p.where("to_world"), "'to_world' of the sensor cannot be inverted");
        read_clip(p, camera);
    } else {
        check_frame(camera.to_world, "a sensor", p.where("to_world"));
        camera.fov_x_degrees = read_fov(p, double(context.scene.film.width) / double(context.scene.film.height));
        read_clip(p, camera);
        read_lens(p, camera);
    }
    read_shutter(p, camera);
    if (const Element* medium = p.object("medium")) camera.medium = medium_of(*medium, context);
    if (const Element* sampler = p.object("sampler")) read_sampler(*sampler, context);
    p.finish();
}

}  // namespace koksma::loader
