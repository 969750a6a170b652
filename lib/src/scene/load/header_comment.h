#pragma once
// "purpose:" and "expect:" of a scene file's first comment.

#include <koksma/scene/description.h>

#include <string_view>

namespace koksma::loader {

/// Lines after a key belong to it until the next "key:" line.
void read_header_comment(std::string_view comment, SceneDescription& scene);

}  // namespace koksma::loader
