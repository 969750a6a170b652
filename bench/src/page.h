#pragma once
// Numbers to a file, and from there by Python to a page.

#include <nlohmann/json_fwd.hpp>

#include <filesystem>
#include <string>

namespace koksma {

/// Whole or not at all. @throws Error naming the file
void write_json(const std::filesystem::path& file, const nlohmann::ordered_json& json);

/// Runs `python3 -m MODULE NUMBERS PAGE` with the report's package. @throws Error saying what is missing
void draw_page(const std::string& module, const std::filesystem::path& numbers, const std::filesystem::path& page);

}  // namespace koksma
