#pragma once
// Metals by name.

#include <koksma/scene/description.h>

#include <string>

namespace koksma::loader {

struct Metal {
    Rgb eta, k;
};

/// @throws Error at `where` for a name that is not known
[[nodiscard]] Metal named_metal(const std::string& name, const SourceLocation& where);

}  // namespace koksma::loader
