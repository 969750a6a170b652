#pragma once
// The header of a PLY file.

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace koksma::loader {

enum class PlyFormat { ascii, little_endian, big_endian };
enum class PlyType { int8, uint8, int16, uint16, int32, uint32, float32, float64 };

[[nodiscard]] std::size_t size_of(PlyType type) noexcept;

struct PlyProperty {
    std::string name;
    PlyType type{};
    bool is_list = false;
    PlyType count_type{};
};

struct PlyElement {
    std::string name;
    std::size_t count = 0;
    std::vector<PlyProperty> properties;
};

struct PlyHeader {
    PlyFormat format = PlyFormat::ascii;
    std::vector<PlyElement> elements;
    std::size_t body = 0;  ///< where the data begins, in bytes
    int body_line = 0;     ///< the same, as a line
};

/// @throws Error file:line
[[nodiscard]] PlyHeader parse_ply_header(std::string_view bytes, const std::filesystem::path& file);

}  // namespace koksma::loader
