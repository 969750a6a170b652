#pragma once

#include <nlohmann/json.hpp>

#include <string>

namespace koksma {

/// What the JSON library found, without the name of its exception.
[[nodiscard]] inline std::string text_of(const nlohmann::json::exception& e) {
    const std::string text = e.what();
    const auto end = text.find("] ");
    return end == std::string::npos ? text : text.substr(end + 2);
}

}  // namespace koksma
