#pragma once
// <rgb>, <spectrum>, <float> as colours, and what range each use of a colour has.

#include "element.h"

namespace koksma::loader {

enum class ColorUse {
    reflectance,  ///< [0, 1]
    emission,     ///< finite, not negative
    index,        ///< eta and k of metals: finite, not negative
    roughness,    ///< finite, not negative
    any           ///< finite; checked later against the use of the texture around it
};

/// @throws Error for malformed numbers and values out of range
[[nodiscard]] Rgb parse_color(const Element& element, ColorUse use);

/// @throws Error at `where` if the value is out of the range of `use`; `what` names it
void check_color(const Rgb& value, ColorUse use, const SourceLocation& where, std::string_view what);

}  // namespace koksma::loader
