#pragma once
// The parameters of one plugin (<shape type="...">, <bsdf ...>): typed, each with a "was it read" flag.

#include "element.h"

#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace koksma::loader {

/// Everything with an id, over all files of a scene.
using IdTable = std::map<std::string, const Element*>;

/// Reads the children of a plugin's element. Getters name what is supported; finish() refuses everything that no getter asked for.
class Properties {
public:
    /// @param supported_types  for the error when `type` is another one
    Properties(const Element& element, const IdTable& ids, const std::vector<std::string>& supported_types);

    [[nodiscard]] const std::string& type() const noexcept { return *type_; }
    [[nodiscard]] const std::string& id() const noexcept { return id_; }
    [[nodiscard]] const SourceLocation& where() const noexcept { return element_.where; }

    [[nodiscard]] bool has(std::string_view name) const noexcept;
    /// True if the parameter is there and written with this tag.
    [[nodiscard]] bool is(std::string_view name, std::string_view tag) const noexcept;
    /// <float> or <integer>; finite.
    [[nodiscard]] double number(const std::string& name, double default_value);
    [[nodiscard]] double required_number(const std::string& name);
    /// <integer> in [lowest, highest].
    [[nodiscard]] std::int64_t integer(const std::string& name, std::int64_t default_value, std::int64_t lowest, std::int64_t highest);
    [[nodiscard]] bool boolean(const std::string& name, bool default_value);
    [[nodiscard]] std::string text(const std::string& name, const std::string& default_value);
    [[nodiscard]] std::string required_text(const std::string& name);
    /// A <string> that is one of `values`.
    [[nodiscard]] std::string choice(const std::string& name, const std::string& default_value, const std::vector<std::string>& values);
    [[nodiscard]] glm::dvec3 point(const std::string& name, const glm::dvec3& default_value);
    [[nodiscard]] glm::dmat4 transform(const std::string& name);
    /// A <transform> at time 0, or an <animation>; of what has none, at rest where it is.
    [[nodiscard]] Animation placements(const std::string& name);
    /// A colour or a texture, <ref>s followed; nullptr if it is absent.
    [[nodiscard]] const Element* value(const std::string& name);
    /// A colour or a volume, <ref>s followed; nullptr if it is absent.
    [[nodiscard]] const Element* field(const std::string& name);
    /// The object of a tag that has this name, <ref>s followed; nullptr if it is absent.
    [[nodiscard]] const Element* named_object(const std::string& name, std::string_view tag);
    /// Where a parameter stands; the plugin itself if it is absent.
    [[nodiscard]] const SourceLocation& where(std::string_view name) const noexcept;

    /// Nested objects of one tag, <ref>s followed.
    [[nodiscard]] std::vector<const Element*> objects(const std::string& tag);
    /// The one nested object of a tag, or nullptr. @throws Error for two
    [[nodiscard]] const Element* object(const std::string& tag);
    /// Every parameter that has not been read, as name and text; for samplers, whose options the registry checks.
    [[nodiscard]] std::vector<Attribute> remaining_scalars();
    /// Gives up on the parameters: none of them is refused.
    void ignore_rest() noexcept;

    /// @throws Error for the first parameter or object that was not read, with those that are supported
    void finish() const;

private:
    struct Child {
        const Element* written;  ///< the element in the plugin: a parameter, an object or a <ref>
        const Element* meant;    ///< the same, or what the <ref> points to
        std::string name;
        bool read = false;
    };
    [[nodiscard]] Child* take(const std::string& name, std::initializer_list<std::string_view> tags, std::string_view what);
    [[nodiscard]] const Child* find(std::string_view name) const noexcept;

    const Element& element_;
    const std::string* type_;
    std::string id_;
    std::vector<Child> children_;
    std::vector<std::string> asked_, asked_objects_;
};

/// Collects the ids of elements and of what is nested in them. @throws Error for an id used twice
void collect_ids(const std::vector<Element>& elements, IdTable& ids);

/// What a <ref> points to. @throws Error for an unknown id
[[nodiscard]] const Element& follow(const Element& ref, const IdTable& ids);

}  // namespace koksma::loader
