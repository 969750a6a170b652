#pragma once
// The message with which something is refused.

#include <koksma/sampling/error.h>

#include <string>
#include <string_view>
#include <utility>

namespace koksma::test {

/// What the Error says that `f` throws; "accepted" if it throws none.
template <class F>
[[nodiscard]] std::string refusal(F&& f) {
    try {
        std::forward<F>(f)();
    } catch (const Error& e) {
        return e.what();
    }
    return "accepted";
}

[[nodiscard]] inline bool contains(const std::string& text, std::string_view part) { return text.find(part) != std::string::npos; }

}  // namespace koksma::test
