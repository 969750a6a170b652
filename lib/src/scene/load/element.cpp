#include "element.h"

#include "fail.h"

#include <algorithm>

namespace koksma::loader {

const std::string* Element::find(std::string_view name) const noexcept {
    const auto it = std::find_if(attributes.begin(), attributes.end(), [&](const Attribute& a) { return a.name == name; });
    return it == attributes.end() ? nullptr : &it->value;
}

const std::string& Element::required(std::string_view name) const {
    if (const std::string* value = find(name)) return *value;
    fail(where, "<{}> needs the attribute '{}'", tag, name);
}

void Element::allow_attributes(std::initializer_list<std::string_view> names) const {
    for (std::size_t i = 0; i < attributes.size(); ++i) {
        const std::string& name = attributes[i].name;
        if (std::find(names.begin(), names.end(), name) == names.end())
            fail(where, "<{}> has an unknown attribute '{}'; supported: {}", tag, name,
                 list_of(std::vector<std::string>(names.begin(), names.end())));
        for (std::size_t j = 0; j < i; ++j)
            if (attributes[j].name == name) fail(where, "<{}> has the attribute '{}' twice", tag, name);
    }
}

void Element::allow_no_children() const {
    if (!children.empty()) fail(children.front().where, "<{}> inside <{}>, which takes no children", children.front().tag, tag);
}

}  // namespace koksma::loader
