#pragma once
// <transform>, <animation>, <point> and <vector>.

#include "element.h"

#include <glm/mat3x3.hpp>
#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>

namespace koksma::loader {

/// x, y and z, or one "value" of three numbers. @throws Error
[[nodiscard]] glm::dvec3 parse_point(const Element& element);

/// The steps of a <transform>, each applied after the one before. @throws Error
[[nodiscard]] glm::dmat4 parse_transform(const Element& element);

/// <transform time="..."> after <transform time="...">, in order of time: as in Mitsuba 0.6 (Mitsuba 3 has no motion). @throws Error
[[nodiscard]] Animation parse_animation(const Element& element);

/// What a 4x4 matrix does to (u, v): the xy block and the translation; z is dropped, as in Mitsuba.
[[nodiscard]] glm::dmat3 uv_transform(const glm::dmat4& m) noexcept;

/// True if the linear part is a rotation or reflection times one scale factor, up to a relative tolerance of squared lengths.
[[nodiscard]] bool is_similarity(const glm::dmat4& m, double tolerance) noexcept;

}  // namespace koksma::loader
