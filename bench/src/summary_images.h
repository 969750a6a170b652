#pragma once
// What the kept replicates say: spectra, blurred errors, maps of where the error is.

#include "row.h"

#include <koksma/measure/reference.h>

#include <nlohmann/json.hpp>

#include <filesystem>
#include <string>
#include <vector>

namespace koksma {

/// Keeps what the statistics need of a reference beside the replicates.
void save_reference_images(const std::filesystem::path& folder, const std::string& scene, const Reference& reference);

/// @param what  "mean" or "variance"
[[nodiscard]] std::filesystem::path reference_image(const std::filesystem::path& folder, const std::string& scene, const char* what);

/// Writes the reference and the first replicate of each sampler at crop_spp as crops/SCENE-*.exr, without a word on machine or commit, and as .npy of shape
/// (height, width, 3); names them in a summary as "reference_data", "crop_data" and "crop_exr", null where there is no image.
void add_crops(const std::filesystem::path& folder, const nlohmann::ordered_json& header, const std::vector<Row>& rows, nlohmann::ordered_json& summary);

/// Standard deviations of the Gaussian filters, in pixels.
inline constexpr double kBlurs[] = {1.0, 2.0};

/// Adds "image_error" to each sampler of each scene of a summary, null where there are no images, and writes maps as maps/SCENE-SAMPLER-*.npy.
void add_image_errors(const std::filesystem::path& folder, const nlohmann::ordered_json& header, const std::vector<Row>& rows, nlohmann::ordered_json& summary);

}  // namespace koksma
