#pragma once
// <shape>: obj, ply, rectangle, disk, cube, sphere.

#include "context.h"

namespace koksma::loader {

/// Adds a <shape> with its material and emission to the scene. @throws Error
void read_shape(const Element& shape, Context& context);

}  // namespace koksma::loader
