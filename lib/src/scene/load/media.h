#pragma once
// <medium>, <phase> and <volume>.

#include "context.h"

namespace koksma::loader {

/// Reads a medium, once an element. @return  index into SceneDescription::media
[[nodiscard]] std::uint32_t medium_of(const Element& medium, Context& context);

/// Reads a medium, phase or volume that nothing uses, for its mistakes. @throws Error
void check_medium_object(const Element& element, Context& context);

}  // namespace koksma::loader
