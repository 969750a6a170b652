#include "properties.h"

#include "fail.h"
#include "numbers.h"
#include "transforms.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace koksma::loader {
namespace {

constexpr std::array<std::string_view, 10> kParameterTags{"float",    "integer", "boolean", "string",    "rgb",
                                                          "spectrum", "point",   "vector",  "transform", "animation"};
constexpr std::array<std::string_view, 12> kObjectTags{"bsdf",    "texture",    "shape",   "emitter", "sensor", "film",
                                                       "sampler", "integrator", "rfilter", "medium",  "phase",  "volume"};

bool is_parameter(std::string_view tag) { return std::find(kParameterTags.begin(), kParameterTags.end(), tag) != kParameterTags.end(); }
bool is_object(std::string_view tag) { return std::find(kObjectTags.begin(), kObjectTags.end(), tag) != kObjectTags.end(); }

std::vector<std::string> known_tags() {
    std::vector<std::string> tags(kParameterTags.begin(), kParameterTags.end());
    tags.insert(tags.end(), kObjectTags.begin(), kObjectTags.end());
    tags.emplace_back("ref");
    return tags;
}

}  // namespace

void collect_ids(const std::vector<Element>& elements, IdTable& ids) {
    const auto add = [&](const std::string& id, const Element* target, const Element& written) {
        if (id.empty()) fail(written.where, "an id is empty");
        const auto [it, is_new] = ids.emplace(id, target);
        if (!is_new) fail(written.where, "id '{}' is used twice; the first is at {}", id, it->second->where.text());
    };
    for (const Element& e : elements) {
        if (e.tag == "alias") {
            e.allow_attributes({"id", "as"});
            const auto it = ids.find(e.required("id"));
            if (it == ids.end()) fail(e.where, "<alias> of '{}', which has not been defined above", e.required("id"));
            const Element* target = it->second;
            add(e.required("as"), target, e);
        } else if (is_object(e.tag)) {
            if (const std::string* id = e.find("id")) add(*id, &e, e);
            collect_ids(e.children, ids);
        }
    }
}

const Element& follow(const Element& ref, const IdTable& ids) {
    ref.allow_attributes({"id", "name"});
    ref.allow_no_children();
    const std::string& id = ref.required("id");
    if (const auto it = ids.find(id); it != ids.end()) return *it->second;
    std::vector<std::string> names;
    for (const auto& [name, element] : ids) names.push_back(name);
    fail(ref.where, "there is nothing with id '{}'; {}ids: {}", id, did_you_mean(id, names), list_of(names));
}

Properties::Properties(const Element& element, const IdTable& ids, const std::vector<std::string>& supported_types) : element_(element) {
    element.allow_attributes({"type", "id", "name"});
    type_ = &element.required("type");
    if (std::find(supported_types.begin(), supported_types.end(), *type_) == supported_types.end() && !supported_types.empty())
        fail(element.where, "{} type '{}' is not supported; {}supported: {}", element.tag, *type_, did_you_mean(*type_, supported_types),
             list_of(supported_types));
    if (const std::string* id = element.find("id")) id_ = *id;
    for (const Element& child : element.children) {
        const bool parameter = is_parameter(child.tag), object = is_object(child.tag);
        if (!parameter && !object && child.tag != "ref") {
            const auto tags = known_tags();
            fail(child.where, "<{}> is not supported in a {}; {}supported: {}", child.tag, element.tag, did_you_mean(child.tag, tags),
                 list_of(tags));
        }
        Child c{&child, &child, {}};
        if (parameter) (void)child.required("name");
        if (const std::string* name = child.find("name")) c.name = *name;
        if (child.tag == "ref") c.meant = &follow(child, ids);
        if (!c.name.empty())
            if (const Child* first = find(c.name))
                fail(child.where, "'{}' is given twice; the first is at {}", c.name, first->written->where.text());
        children_.push_back(std::move(c));
    }
}

const Properties::Child* Properties::find(std::string_view name) const noexcept {
    const auto it = std::find_if(children_.begin(), children_.end(), [&](const Child& c) { return c.name == name; });
    return it == children_.end() ? nullptr : &*it;
}

bool Properties::has(std::string_view name) const noexcept { return find(name) != nullptr; }

bool Properties::is(std::string_view name, std::string_view tag) const noexcept {
    const Child* child = find(name);
    return child && child->meant->tag == tag;
}

const SourceLocation& Properties::where(std::string_view name) const noexcept {
    const Child* child = find(name);
    return child ? child->written->where : element_.where;
}

Properties::Child* Properties::take(const std::string& name, std::initializer_list<std::string_view> tags, std::string_view what) {
    if (std::find(asked_.begin(), asked_.end(), name) == asked_.end()) asked_.push_back(name);
    const auto it = std::find_if(children_.begin(), children_.end(), [&](const Child& c) { return c.name == name; });
    if (it == children_.end()) return nullptr;
    if (std::find(tags.begin(), tags.end(), it->meant->tag) == tags.end())
        fail(it->written->where, "'{}' of {} '{}' must be {}, found <{}>", name, element_.tag, type(), what, it->meant->tag);
    it->read = true;
    return &*it;
}

double Properties::number(const std::string& name, double default_value) {
    const Child* child = take(name, {"float", "integer"}, "a <float>");
    if (!child) return default_value;
    child->written->allow_attributes({"name", "value"});
    child->written->allow_no_children();
    const std::string& text = child->written->required("value");
    const auto value = parse_double(text);
    if (!value) fail(child->written->where, "'{}' is not a number ('{}')", text, name);
    if (!finite_float(*value)) fail(child->written->where, "'{}' must be finite and fit a float, found {}", name, trimmed(text));
    return *value;
}

double Properties::required_number(const std::string& name) {
    if (!has(name)) fail(where(), "{} '{}' needs <float name=\"{}\" .../>", element_.tag, type(), name);
    return number(name, 0.0);
}

std::int64_t Properties::integer(const std::string& name, std::int64_t default_value, std::int64_t lowest, std::int64_t highest) {
    const Child* child = take(name, {"integer"}, "an <integer>");
    if (!child) return default_value;
    child->written->allow_attributes({"name", "value"});
    child->written->allow_no_children();
    const std::string& text = child->written->required("value");
    const auto value = parse_int64(text);
    if (!value) fail(child->written->where, "'{}' is not an integer of at most 64 bits ('{}')", text, name);
    if (*value < lowest || *value > highest)
        fail(child->written->where, "'{}' is {}; it must be in [{}, {}]", name, *value, lowest, highest);
    return *value;
}

bool Properties::boolean(const std::string& name, bool default_value) {
    const Child* child = take(name, {"boolean"}, "a <boolean>");
    if (!child) return default_value;
    child->written->allow_attributes({"name", "value"});
    child->written->allow_no_children();
    std::string text(trimmed(child->written->required("value")));
    for (char& c : text)
        if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');  // Mitsuba takes "True"
    if (text != "true" && text != "false") fail(child->written->where, "'{}' must be true or false, found '{}'", name, text);
    return text == "true";
}

std::string Properties::text(const std::string& name, const std::string& default_value) {
    const Child* child = take(name, {"string"}, "a <string>");
    if (!child) return default_value;
    child->written->allow_attributes({"name", "value"});
    child->written->allow_no_children();
    return child->written->required("value");
}

std::string Properties::required_text(const std::string& name) {
    if (!has(name)) fail(where(), "{} '{}' needs <string name=\"{}\" .../>", element_.tag, type(), name);
    return text(name, {});
}

std::string Properties::choice(const std::string& name, const std::string& default_value, const std::vector<std::string>& values) {
    std::string chosen = text(name, default_value);
    if (std::find(values.begin(), values.end(), chosen) == values.end())
        fail(where(name), "'{}' is '{}'; {}supported: {}", name, chosen, did_you_mean(chosen, values), list_of(values));
    return chosen;
}

glm::dvec3 Properties::point(const std::string& name, const glm::dvec3& default_value) {
    const Child* child = take(name, {"point", "vector"}, "a <point>");
    return child ? parse_point(*child->written) : default_value;
}

glm::dmat4 Properties::transform(const std::string& name) {
    const Child* child = take(name, {"transform"}, "a <transform>");
    return child ? parse_transform(*child->written) : glm::dmat4(1.0);
}

Animation Properties::placements(const std::string& name) {
    const Child* child = take(name, {"transform", "animation"}, "a <transform> or an <animation>");
    if (!child) return {{0.0, glm::dmat4(1.0)}};
    return child->written->tag == "animation" ? parse_animation(*child->written) : Animation{{0.0, parse_transform(*child->written)}};
}

const Element* Properties::value(const std::string& name) {
    const Child* child = take(name, {"float", "integer", "rgb", "spectrum", "texture"}, "a colour or a texture");
    return child ? child->meant : nullptr;
}

const Element* Properties::field(const std::string& name) {
    const Child* child = take(name, {"float", "integer", "rgb", "spectrum", "volume"}, "a colour or a volume");
    return child ? child->meant : nullptr;
}

const Element* Properties::named_object(const std::string& name, std::string_view tag) {
    const Child* child = take(name, {tag}, fmt::format("a {}", tag));
    return child ? child->meant : nullptr;
}

std::vector<const Element*> Properties::objects(const std::string& tag) {
    asked_objects_.push_back(tag);
    std::vector<const Element*> found;
    for (Child& c : children_)
        if (c.meant->tag == tag) c.read = true, found.push_back(c.meant);
    return found;
}

const Element* Properties::object(const std::string& tag) {
    asked_objects_.push_back(tag);
    const Child* first = nullptr;
    for (Child& c : children_) {
        if (c.meant->tag != tag) continue;
        if (first)
            fail(c.written->where, "{} '{}' takes one {}; the first is at {}", element_.tag, type(), tag, first->written->where.text());
        c.read = true;
        first = &c;
    }
    return first ? first->meant : nullptr;
}

std::vector<Attribute> Properties::remaining_scalars() {
    std::vector<Attribute> all;
    for (Child& c : children_) {
        const std::string& tag = c.written->tag;
        if (c.read || (tag != "string" && tag != "integer" && tag != "float" && tag != "boolean")) continue;
        c.written->allow_attributes({"name", "value"});
        c.read = true;
        all.push_back({c.name, std::string(trimmed(c.written->required("value")))});
    }
    return all;
}

void Properties::ignore_rest() noexcept {
    for (Child& c : children_) c.read = true;
}

void Properties::finish() const {
    for (const Child& c : children_) {
        if (c.read) continue;
        const std::string& tag = c.meant->tag;
        if (is_parameter(tag) || !c.name.empty())
            fail(c.written->where, "{} '{}' has no parameter '{}' here; {}supported: {}", element_.tag, type(), c.name,
                 did_you_mean(c.name, asked_), list_of(asked_));
        fail(c.written->where, "{} '{}' takes no {} here; supported objects: {}", element_.tag, type(), tag, list_of(asked_objects_));
    }
}

}  // namespace koksma::loader
