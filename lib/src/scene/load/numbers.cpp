#include "numbers.h"

#include <charconv>
#include <cmath>
#include <limits>
#include <system_error>

namespace koksma::loader {

std::string_view trimmed(std::string_view text) noexcept {
    constexpr std::string_view kBlank = " \t\r\n";
    const auto first = text.find_first_not_of(kBlank);
    if (first == std::string_view::npos) return {};
    return text.substr(first, text.find_last_not_of(kBlank) - first + 1);
}

namespace {
template <class T>
std::optional<T> parse_whole(std::string_view text) noexcept {
    T value{};
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc{} || end != text.data() + text.size()) return std::nullopt;
    return value;
}
}  // namespace

std::optional<double> parse_double(std::string_view text) noexcept {
    text = trimmed(text);
    if (text.starts_with('+') && !text.starts_with("+-")) text.remove_prefix(1);  // Mitsuba takes "+1"; from_chars does not
    return parse_whole<double>(text);
}

std::optional<std::int64_t> parse_int64(std::string_view text) noexcept { return parse_whole<std::int64_t>(trimmed(text)); }

std::optional<std::vector<double>> parse_doubles(std::string_view text) {
    constexpr std::string_view kSeparators = ", \t\r\n";
    std::vector<double> values;
    for (auto begin = text.find_first_not_of(kSeparators); begin != std::string_view::npos;) {
        const auto end = text.find_first_of(kSeparators, begin);
        const auto value = parse_double(text.substr(begin, end - begin));
        if (!value) return std::nullopt;
        values.push_back(*value);
        begin = end == std::string_view::npos ? end : text.find_first_not_of(kSeparators, end);
    }
    if (values.empty()) return std::nullopt;
    return values;
}

std::optional<float> finite_float(double value) noexcept {
    if (!(std::abs(value) <= static_cast<double>(std::numeric_limits<float>::max()))) return std::nullopt;
    return static_cast<float>(value);
}

}  // namespace koksma::loader
