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

/// Standard deviations of the Gaussian filters, in pixels.
inline constexpr double kBlurs[] = {1.0, 2.0};

/// Adds "image_error" to each sampler of each scene of a summary, null where there are no images, and writes maps as maps/SCENE-SAMPLER-*.npy.
void add_image_errors(const std::filesystem::path& folder, const nlohmann::ordered_json& header, const std::vector<Row>& rows, nlohmann::ordered_json& summary);

}  // namespace koksma
