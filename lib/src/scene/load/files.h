#pragma once
// Finding and reading the files that a scene names.

#include "element.h"

#include <filesystem>
#include <string>

namespace koksma::loader {

/// A whole file. @throws Error naming the file, without a location
[[nodiscard]] std::string read_file(const std::filesystem::path& file);

/// The file that `name` means: beside the (included) file that says so, else beside the main scene file; Mitsuba's order.
/// @throws Error with the paths tried
[[nodiscard]] std::filesystem::path resolve(const std::string& name, const std::filesystem::path& scene_directory,
                                            const SourceLocation& where);

}  // namespace koksma::loader
