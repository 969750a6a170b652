#pragma once
// How the loader reports a mistake, and the lists of names that go with it.

#include <koksma/sampling/error.h>
#include <koksma/scene/description.h>

#include <fmt/format.h>

#include <span>
#include <string>
#include <string_view>
#include <utility>

namespace koksma::loader {

/// @throws Error "file:line:column: message", always
template <class... Args>
[[noreturn]] void fail(const SourceLocation& where, fmt::format_string<Args...> text, Args&&... args) {
    throw Error(where.text() + ": " + fmt::format(text, std::forward<Args>(args)...));
}

/// "a, b, c", or "none".
[[nodiscard]] std::string list_of(std::span<const std::string> names);

/// "did you mean 'x'? " for the name nearest to `wanted` if one is near, else "".
[[nodiscard]] std::string did_you_mean(std::string_view wanted, std::span<const std::string> names);

}  // namespace koksma::loader
