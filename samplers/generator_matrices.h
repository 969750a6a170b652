#pragma once
// Generator matrices of a digital sequence in a prime base, as read from a file.

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace koksma {

/// Digit r of coordinate d, of weight base^-(r+1), is sum_c entry(d, r, c) a_c modulo the base, a_c digit c of the index.
struct GeneratorMatrices {
    std::uint32_t base = 2;        ///< a prime up to 8161
    std::uint32_t dimensions = 0;
    std::uint32_t rows = 0;        ///< digits of a coordinate, at least `columns`
    std::uint32_t columns = 0;     ///< digits of an index: base^columns points
    std::vector<std::uint16_t> entries{};  ///< [(d * rows + r) * columns + c]
    /// In every dimension the first m rows and columns are regular for every m: every b^m points from a multiple of b^m on have
    /// one value in each interval of length b^-m.
    bool stratified = true;

    [[nodiscard]] std::uint32_t entry(std::size_t d, std::size_t r, std::size_t c) const noexcept { return entries[(d * rows + r) * columns + c]; }
    /// base^columns, or 2^64 - 1 if that is less.
    [[nodiscard]] std::uint64_t point_count() const noexcept;

    /// The format is described in docs/samplers/matrices.md.
    /// @throws Error "FILE:LINE: what was found, what was expected"
    [[nodiscard]] static GeneratorMatrices parse(std::string_view text, const std::string& file);
};

}  // namespace koksma
