#pragma once
// <shape>: meshes, simple shapes, groups and their instances.

#include "context.h"

namespace koksma::loader {

/// Adds a <shape> with its material and emission, or an instance with its group, to the scene. A group alone is not seen: nothing is added.
/// @throws Error
void read_shape(const Element& shape, Context& context);

/// @throws Error
[[nodiscard]] ShapeGroup parse_group(const Element& group, Context& context);

}  // namespace koksma::loader
