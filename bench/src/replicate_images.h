#pragma once
// Renders that are kept as images: the replicates at an experiment's crop_spp, from which crops, error maps and spectra are made.

#include "bench_scene.h"
#include "row.h"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace koksma {

/// "images/cornell-sobol-randomize-owen-16-0.exr", relative to the results' folder.
[[nodiscard]] std::string image_name(const Row& row);

/// Writes a replicate with the key of its row. @throws Error
void save_replicate(const std::filesystem::path& folder, const Row& row, const std::vector<float>& image);

/// @return the image, shape (height, width, 3), where the file is there and is that of the row
[[nodiscard]] std::optional<std::vector<float>> load_replicate(const std::filesystem::path& folder, const Row& row);

}  // namespace koksma
