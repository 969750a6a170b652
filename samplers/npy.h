#pragma once
// Arrays of floats in NumPy's file format.

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace koksma {

struct NpyArray {
    std::vector<std::size_t> shape{};
    std::vector<double> values{};  ///< C order
};

/// Reads format versions 1, 2 and 3, little-endian float32 or float64, C order.
/// @throws Error naming the file and what is wrong: not an .npy file, another type or order, a size that is not that of the shape
/// Source: "numpy.lib.format", NumPy's specification of the format (NEP 1)
[[nodiscard]] NpyArray parse_npy(std::string_view bytes, const std::string& file);

/// Whether a file begins as .npy files do.
[[nodiscard]] bool is_npy(std::string_view bytes) noexcept;

}  // namespace koksma
