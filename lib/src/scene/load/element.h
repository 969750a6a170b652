#pragma once
// An XML element as a plain value: parameters substituted, includes pulled in.

#include <koksma/scene/description.h>

#include <initializer_list>
#include <string>
#include <string_view>
#include <vector>

namespace koksma::loader {

struct Attribute {
    std::string name, value;
};

struct Element {
    std::string tag;
    std::vector<Attribute> attributes;
    std::vector<Element> children;
    SourceLocation where;

    /// The value of an attribute, or nullptr.
    [[nodiscard]] const std::string* find(std::string_view name) const noexcept;
    /// The value of an attribute. @throws Error if it is missing
    [[nodiscard]] const std::string& required(std::string_view name) const;
    /// @throws Error if there is an attribute of another name
    void allow_attributes(std::initializer_list<std::string_view> names) const;
    /// @throws Error if there are children
    void allow_no_children() const;
};

}  // namespace koksma::loader
