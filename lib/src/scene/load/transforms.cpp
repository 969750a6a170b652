#include "transforms.h"

#include "fail.h"
#include "numbers.h"

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include <cmath>
#include <numbers>

namespace koksma::loader {
namespace {

std::vector<double> finite_numbers(const Element& element, std::string_view attribute, std::size_t count, std::size_t other_count = 0) {
    const std::string& text = element.required(attribute);
    const auto values = parse_doubles(text);
    if (!values) fail(element.where, "'{}' in <{}> is not a list of numbers", text, element.tag);
    if (values->size() != count && values->size() != other_count)
        fail(element.where, "'{}' of <{}> must have {}{} numbers, found {}", attribute, element.tag, count,
             other_count ? fmt::format(" or {}", other_count) : "", values->size());
    for (const double v : *values)
        if (!finite_float(v)) fail(element.where, "'{}' in <{}>: every number must be finite and fit a float", text, element.tag);
    return *values;
}

double scalar(const Element& element, std::string_view attribute) { return finite_numbers(element, attribute, 1)[0]; }

/// x/y/z, or value="a" or "a, b, c".
glm::dvec3 xyz(const Element& element, double default_value) {
    if (element.find("value")) {
        for (const char* axis : {"x", "y", "z"})
            if (element.find(axis)) fail(element.where, "<{}> has both 'value' and '{}'", element.tag, axis);
        const auto v = finite_numbers(element, "value", 3, 1);
        return v.size() == 1 ? glm::dvec3(v[0]) : glm::dvec3(v[0], v[1], v[2]);
    }
    glm::dvec3 result(default_value);
    if (element.find("x")) result.x = scalar(element, "x");
    if (element.find("y")) result.y = scalar(element, "y");
    if (element.find("z")) result.z = scalar(element, "z");
    return result;
}

glm::dmat4 translation(const Element& e) {
    e.allow_attributes({"x", "y", "z", "value"});
    glm::dmat4 m(1.0);
    m[3] = glm::dvec4(xyz(e, 0.0), 1.0);
    return m;
}

glm::dmat4 scaling(const Element& e) {
    e.allow_attributes({"x", "y", "z", "value"});
    const glm::dvec3 s = xyz(e, 1.0);
    glm::dmat4 m(1.0);
    for (int i = 0; i < 3; ++i) m[i][i] = s[i];
    return m;
}

/// Rodrigues' formula. Mitsuba 3.9 does not normalise the axis (and makes something else of a longer one), so only unit axes are taken.
glm::dmat4 rotation(const Element& e) {
    e.allow_attributes({"x", "y", "z", "value", "angle"});
    const glm::dvec3 given = xyz(e, 0.0);
    const double length = glm::length(given);
    if (!(length > 0.0)) fail(e.where, "the axis of <rotate> is zero; give x, y or z");
    const glm::dvec3 a = given / length;
    if (std::abs(length - 1.0) > 1e-4)  // four digits, as people write 0.5774
        fail(e.where,
             "the axis of <rotate> has length {:.6g}, and Mitsuba 3 does not normalise it; write x=\"{:.9g}\" y=\"{:.9g}\" z=\"{:.9g}\"",
             length, a.x, a.y, a.z);
    double degrees = std::fmod(scalar(e, "angle"), 360.0);
    double s = std::sin(degrees * std::numbers::pi / 180.0), c = std::cos(degrees * std::numbers::pi / 180.0);
    if (std::fmod(degrees, 90.0) == 0.0) s = std::round(s), c = std::round(c);  // right angles exactly
    glm::dmat4 m(1.0);
    for (int column = 0; column < 3; ++column) {
        glm::dvec3 axis(0.0);
        axis[column] = 1.0;
        m[column] = glm::dvec4(axis * c + glm::cross(a, axis) * s + a * (a[column] * (1.0 - c)), 0.0);
    }
    return m;
}

/// Row by row; 9 numbers are the linear part.
glm::dmat4 matrix(const Element& e) {
    e.allow_attributes({"value"});
    const auto v = finite_numbers(e, "value", 16, 9);
    const int n = v.size() == 9 ? 3 : 4;
    glm::dmat4 m(1.0);
    for (int row = 0; row < n; ++row)
        for (int column = 0; column < n; ++column) m[column][row] = v[static_cast<std::size_t>(row * n + column)];
    if (m[0][3] != 0.0 || m[1][3] != 0.0 || m[2][3] != 0.0 || m[3][3] != 1.0)
        fail(e.where, "the last row of <matrix> is {} {} {} {}; only 0 0 0 1 is supported", m[0][3], m[1][3], m[2][3], m[3][3]);
    return m;
}

/// Looks along +z from origin, +x to the left. Without `up`, the frame of Duff et al. 2017, "Building an Orthonormal Basis,
/// Revisited", JCGT 6(1), listing 3, which is Mitsuba's choice.
glm::dmat4 look_at(const Element& e) {
    e.allow_attributes({"origin", "target", "up"});
    const auto vec = [&](std::string_view name) {
        const auto v = finite_numbers(e, name, 3);
        return glm::dvec3(v[0], v[1], v[2]);
    };
    const glm::dvec3 origin = vec("origin"), target = vec("target");
    if (origin == target) fail(e.where, "<lookat> has its target at its origin");
    const glm::dvec3 dir = glm::normalize(target - origin);
    glm::dvec3 up;
    if (e.find("up")) {
        up = vec("up");
    } else {
        const double sign = std::copysign(1.0, dir.z), a = -1.0 / (sign + dir.z);
        up = glm::dvec3(1.0 + sign * dir.x * dir.x * a, sign * dir.x * dir.y * a, -sign * dir.x);
    }
    const glm::dvec3 across = glm::cross(up, dir);
    if (!(glm::length(across) > 1e-9 * glm::length(up)))  // below this the frame is rounding noise
        fail(e.where, "<lookat> looks along its up vector");
    const glm::dvec3 left = glm::normalize(across);
    return {glm::dvec4(left, 0.0), glm::dvec4(glm::cross(dir, left), 0.0), glm::dvec4(dir, 0.0), glm::dvec4(origin, 1.0)};
}

glm::dmat4 steps_of(const Element& element) {
    glm::dmat4 m(1.0);
    for (const Element& step : element.children) {
        step.allow_no_children();
        if (step.tag == "translate")
            m = translation(step) * m;
        else if (step.tag == "scale")
            m = scaling(step) * m;
        else if (step.tag == "rotate")
            m = rotation(step) * m;
        else if (step.tag == "matrix")
            m = matrix(step) * m;
        else if (step.tag == "lookat")
            m = look_at(step) * m;
        else
            fail(step.where, "<{}> is not a transformation; supported: translate, scale, rotate, matrix, lookat", step.tag);
    }
    return m;
}

}  // namespace

glm::dvec3 parse_point(const Element& element) {
    element.allow_attributes({"name", "value", "x", "y", "z"});
    element.allow_no_children();
    if (!element.find("value"))
        for (const char* axis : {"x", "y", "z"}) (void)element.required(axis);
    else
        (void)finite_numbers(element, "value", 3);
    return xyz(element, 0.0);
}

glm::dmat4 parse_transform(const Element& element) {
    element.allow_attributes({"name"});
    return steps_of(element);
}

Animation parse_animation(const Element& element) {
    element.allow_attributes({"name"});
    Animation animation;
    for (const Element& key : element.children) {
        if (key.tag != "transform") fail(key.where, "<{}> in <animation>; it takes <transform time=\"...\"> only", key.tag);
        key.allow_attributes({"time"});
        const double time = scalar(key, "time");
        if (!animation.empty() && !(time > animation.back().time))
            fail(key.where, "the times of an <animation> must increase, found {} after {}", time, animation.back().time);
        animation.push_back({time, steps_of(key)});
        const double det = glm::determinant(glm::dmat3(animation.back().to_world));
        if (det == 0.0 || !std::isfinite(1.0 / det)) fail(key.where, "this placement cannot be inverted; does it scale by 0?");
    }
    if (animation.empty()) fail(element.where, "<animation> needs a <transform time=\"...\">");
    return animation;
}

glm::dmat3 uv_transform(const glm::dmat4& m) noexcept { return {m[0][0], m[0][1], 0.0, m[1][0], m[1][1], 0.0, m[3][0], m[3][1], 1.0}; }

bool is_similarity(const glm::dmat4& m, double relative) noexcept {
    const glm::dvec3 x(m[0]), y(m[1]), z(m[2]);
    const double xx = glm::dot(x, x), tolerance = relative * xx;
    return std::abs(glm::dot(y, y) - xx) <= tolerance && std::abs(glm::dot(z, z) - xx) <= tolerance &&
           std::abs(glm::dot(x, y)) <= tolerance && std::abs(glm::dot(y, z)) <= tolerance && std::abs(glm::dot(z, x)) <= tolerance;
}

}  // namespace koksma::loader
