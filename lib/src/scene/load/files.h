#pragma once
// Finding and reading the files that a scene names.

#include "element.h"

#include <filesystem>
#include <string>
#include <vector>

namespace koksma::loader {

/// A whole file. @throws Error naming the file, without a location
[[nodiscard]] std::string read_file(const std::filesystem::path& file);

/// Folders in which files are looked for: those of <path>, the last first, then that of the main scene file.
using SearchPath = std::vector<std::filesystem::path>;

/// The file that `name` means: in a folder of a <path>, else beside the (included) file that says so, else beside the main scene
/// file; Mitsuba's order.
/// @throws Error with the paths tried
[[nodiscard]] std::filesystem::path resolve(const std::string& name, const SearchPath& search,
                                            const SourceLocation& where);

}  // namespace koksma::loader
