#pragma once
// Text to numbers, the same in every locale. Trailing characters are an error, not a stop.

#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

namespace koksma::loader {

/// Blanks, tabs and line ends cut off both ends.
[[nodiscard]] std::string_view trimmed(std::string_view text) noexcept;

/// Empty if `text` is not one number (surrounding blanks allowed) or is out of double's range. "nan" and "inf" are numbers here;
/// who calls decides.
[[nodiscard]] std::optional<double> parse_double(std::string_view text) noexcept;

/// Empty if `text` is not one integer or does not fit.
[[nodiscard]] std::optional<std::int64_t> parse_int64(std::string_view text) noexcept;

/// Numbers separated by commas or blanks; empty if one of them is not a number or there is none.
[[nodiscard]] std::optional<std::vector<double>> parse_doubles(std::string_view text);

/// A double as float; empty if it is not finite, before or after.
[[nodiscard]] std::optional<float> finite_float(double value) noexcept;

}  // namespace koksma::loader
