#pragma once
// NumPy files of 32-bit floats.

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace koksma {

/// The header of version 1.0 for C-ordered little-endian floats, padded to a multiple of 64 bytes.
/// Source: NumPy, "NEP 1: A simple file format for NumPy arrays"
[[nodiscard]] std::string npy_header(const std::vector<std::uint64_t>& shape);

/// @param values  as many as the shape says. @throws Error where the file cannot be written
void write_npy(const std::filesystem::path& file, std::span<const float> values, const std::vector<std::uint64_t>& shape);

}  // namespace koksma
