#pragma once
// <emitter>: area (inside a shape), point, constant, envmap.

#include "context.h"

namespace koksma::loader {

/// The emission of the shape that the element stands in, or is referred from. @throws Error, also for a second shape
[[nodiscard]] AreaEmission read_area_emission(const Element& emitter, Context& context);

/// Adds an emitter that stands directly in <scene>. @throws Error
void read_emitter(const Element& emitter, Context& context);

}  // namespace koksma::loader
