#pragma once
// Reading JSON that people write: types are not bent, unknown keys are errors.

#include <koksma/sampling/error.h>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include <cstdint>
#include <set>
#include <string>
#include <type_traits>
#include <vector>

namespace koksma {

// JSON's own conversions turn 1.5 into 1, true into 1 and -4 into 2^64 - 4; these refuse. @return  what was expected, or nullptr
inline const char* convert(const nlohmann::json& json, std::string& value) {
    if (!json.is_string()) return "a string";
    value = json.get<std::string>();
    return nullptr;
}
inline const char* convert(const nlohmann::json& json, double& value) {
    if (!json.is_number()) return "a number";
    value = json.get<double>();
    return nullptr;
}
inline const char* convert(const nlohmann::json& json, std::uint64_t& value) {
    if (!json.is_number_unsigned()) return "an integer, 0 or more";
    value = json.get<std::uint64_t>();
    return nullptr;
}
inline const char* convert(const nlohmann::json& json, bool& value) {
    if (!json.is_boolean()) return "true or false";
    value = json.get<bool>();
    return nullptr;
}
inline const char* convert(const nlohmann::json& json, int& value) {
    if (!json.is_number_integer() || json.get<double>() < -0x1p31 || json.get<double>() >= 0x1p31) return "an integer of 32 bits";
    value = json.get<int>();
    return nullptr;
}
template <class T>
const char* convert(const nlohmann::json& json, std::vector<T>& values) {
    if (!json.is_array()) return "a list";
    values.clear();
    for (const nlohmann::json& item : json)
        if (convert(item, values.emplace_back()) != nullptr)
            return std::is_same_v<T, std::string> ? "a list of strings"
                                                  : (std::is_same_v<T, double> ? "a list of numbers" : "a list of integers in range");
    return nullptr;
}

/// Reads the keys of one object and complains about those that nobody asked for.
class Keys {
public:
    Keys(const nlohmann::json& json, std::string where) : json_(json), where_(std::move(where)) {
        if (!json.is_object()) throw Error(where_ + ": expected an object");
    }
    template <class T>
    void read(const char* key, T& value, bool required) {
        known_.insert(key);
        const auto it = json_.find(key);
        if (it == json_.end()) {
            if (required) throw Error(fmt::format("{}: the key \"{}\" is missing", where_, key));
            return;
        }
        if (const char* expected = convert(*it, value))
            throw Error(fmt::format("{}: \"{}\": expected {}, found {}", where_, key, expected, it->dump()));
    }
    [[nodiscard]] const nlohmann::json* object(const char* key) {
        known_.insert(key);
        const auto it = json_.find(key);
        return it == json_.end() ? nullptr : &*it;
    }
    void done() const {
        for (const auto& item : json_.items())
            if (!known_.contains(item.key()))
                throw Error(fmt::format("{}: unknown key \"{}\"; known keys: {}", where_, item.key(), fmt::join(known_, ", ")));
    }

private:
    const nlohmann::json& json_;
    std::string where_;
    std::set<std::string> known_;
};

}  // namespace koksma
