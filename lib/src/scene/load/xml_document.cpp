#include "xml_document.h"

#include "fail.h"
#include "files.h"
#include "numbers.h"

#include <pugixml.hpp>

#include <algorithm>
#include <cctype>
#include <map>
#include <set>

namespace koksma::loader {
namespace {

constexpr int kMaxIncludeDepth = 15;  // Mitsuba's limit
constexpr int kMaxElementDepth = 64;  // deeper than any scene; keeps the recursion off the end of the stack

/// Byte offset to line and column (both from 1, columns in bytes).
class LineIndex {
public:
    LineIndex(std::string file, const std::string& text) : file_(std::move(file)), starts_{0} {
        for (std::size_t i = 0; i < text.size(); ++i)
            if (text[i] == '\n') starts_.push_back(i + 1);
    }
    [[nodiscard]] SourceLocation at(std::ptrdiff_t offset) const {
        const auto byte = static_cast<std::size_t>(std::max<std::ptrdiff_t>(offset, 0));
        const auto next = std::upper_bound(starts_.begin(), starts_.end(), byte);
        return {file_, static_cast<int>(next - starts_.begin()), static_cast<int>(byte - *(next - 1)) + 1};
    }

private:
    std::string file_;
    std::vector<std::size_t> starts_;
};

class Reader {
public:
    Reader(const SceneParameters& overrides, std::filesystem::path scene_directory)
        : overrides_(overrides), values_(overrides.begin(), overrides.end()), search_{std::move(scene_directory)} {}

    XmlDocument read_main(const std::filesystem::path& file) {
        XmlDocument document;
        document.where = read(file, 0, document.elements, &document.comment);
        for (const auto& [name, value] : overrides_)
            if (!used_.contains(name))
                fail({file.string()}, "parameter '{}' was given but is not used; {}the file has: {}", name, did_you_mean(name, names()),
                     list_of(names()));
        document.search = std::move(search_);
        return document;
    }

private:
    SourceLocation read(const std::filesystem::path& file, int depth, std::vector<Element>& out, std::string* comment) {
        std::string text = read_file(file);
        if (text.starts_with("\xEF\xBB\xBF")) text.erase(0, 3);
        const LineIndex lines(file.string(), text);
        pugi::xml_document xml;
        const auto result = xml.load_buffer(text.data(), text.size(), pugi::parse_default | pugi::parse_comments, pugi::encoding_utf8);
        if (!result) fail(lines.at(result.offset), "this is not well-formed XML: {}", result.description());

        const pugi::xml_node root = xml.document_element();
        const SourceLocation where = lines.at(root.offset_debug() - 1);
        if (std::string_view(root.name()) != "scene") fail(where, "expected <scene> as the outermost element, found <{}>", root.name());
        const Element scene = shallow(root, where);
        scene.allow_attributes({"version"});
        check_version(scene);
        if (comment) *comment = first_comment(xml, root);
        read_children(root, lines, depth, out);
        return where;
    }

    static void check_version(const Element& scene) {
        const std::string& version = scene.required("version");
        // Mitsuba 3 reads files of version 2 as they are.
        if (!(version.starts_with("3.") || version.starts_with("2.")) || version.find_first_not_of("0123456789.") != std::string::npos)
            fail(scene.where, "scene version \"{}\" is not supported; supported: 3.x.y and 2.x.y (Mitsuba 3)", version);
    }

    static std::string first_comment(const pugi::xml_document& xml, const pugi::xml_node& root) {
        for (const pugi::xml_node& node : xml.children()) {
            if (node.type() == pugi::node_comment) return node.value();
            if (node == root) break;
        }
        for (const pugi::xml_node& node : root.children()) {
            if (node.type() == pugi::node_comment) return node.value();
            if (node.type() == pugi::node_element) break;
        }
        return {};
    }

    void read_children(const pugi::xml_node& root, const LineIndex& lines, int depth, std::vector<Element>& out) {
        SourceLocation previous = lines.at(root.offset_debug() - 1);
        for (const pugi::xml_node& node : root.children()) {
            if (!is_element(node, previous)) continue;
            const SourceLocation where = previous = lines.at(node.offset_debug() - 1);
            const std::string_view tag = node.name();
            if (tag == "default")
                define(shallow(node, where));
            else if (tag == "include")
                include(shallow(node, where), depth, out);
            else if (tag == "path")
                add_path(shallow(node, where));
            else
                out.push_back(deep(node, lines, 1));
        }
    }

    /// False for comments. @throws Error for text
    static bool is_element(const pugi::xml_node& node, const SourceLocation& before) {
        if (node.type() == pugi::node_element) return true;
        if (node.type() == pugi::node_pcdata || node.type() == pugi::node_cdata)
            fail(before, "text '{}' inside or after this element; values are given as attributes", trimmed(node.value()));
        return false;
    }

    void define(const Element& element) {
        element.allow_attributes({"name", "value"});
        element.allow_no_children();
        const std::string& name = element.required("name");
        const bool identifier = !name.empty() && std::all_of(name.begin(), name.end(), is_name_character);
        if (!identifier) fail(element.where, "'{}' is not a parameter name; use letters, digits and _", name);
        used_.insert(name);
        values_.emplace(name, element.required("value"));  // the first definition holds, as in Mitsuba
    }

    void include(const Element& element, int depth, std::vector<Element>& out) {
        element.allow_attributes({"filename"});
        element.allow_no_children();
        if (depth >= kMaxIncludeDepth)
            fail(element.where, "includes are nested more than {} deep; does a file include itself?", kMaxIncludeDepth);
        read(resolve(element.required("filename"), search_, element.where), depth + 1, out, nullptr);
    }

    /// A folder to look for files in, before all others.
    void add_path(const Element& element) {
        element.allow_attributes({"value"});
        element.allow_no_children();
        search_.insert(search_.begin(), resolve(element.required("value"), search_, element.where));
    }

    Element shallow(const pugi::xml_node& node, const SourceLocation& where) {
        Element element{node.name(), {}, {}, where};
        for (const pugi::xml_attribute& a : node.attributes()) element.attributes.push_back({a.name(), substituted(a.value(), where)});
        return element;
    }

    Element deep(const pugi::xml_node& node, const LineIndex& lines, int depth) {
        const SourceLocation where = lines.at(node.offset_debug() - 1);
        if (depth > kMaxElementDepth) fail(where, "elements are nested more than {} deep", kMaxElementDepth);
        Element element = shallow(node, where);
        if (element.tag == "default" || element.tag == "include" || element.tag == "path") fail(where, "<{}> is only supported directly in <scene>", element.tag);
        for (const pugi::xml_node& child : node.children())
            if (is_element(child, where)) element.children.push_back(deep(child, lines, depth + 1));
        return element;
    }

    static bool is_name_character(char c) noexcept { return std::isalnum(static_cast<unsigned char>(c)) || c == '_'; }

    /// $name replaced; of several defined names the longest that fits is meant.
    std::string substituted(std::string_view text, const SourceLocation& where) {
        std::string out;
        for (auto dollar = text.find('$'); dollar != std::string_view::npos; dollar = text.find('$')) {
            out += text.substr(0, dollar);
            text.remove_prefix(dollar + 1);
            std::size_t length = 0;
            while (length < text.size() && is_name_character(text[length])) ++length;
            const std::string whole(text.substr(0, length));
            while (length > 0 && !values_.contains(std::string(text.substr(0, length)))) --length;
            if (length == 0)
                fail(where, "parameter '${}' has no value; {}give -D {}=..., or a <default> before this line. Defined here: {}", whole,
                     did_you_mean(whole, names()), whole, list_of(names()));
            const std::string name(text.substr(0, length));
            used_.insert(name);
            out += values_.at(name);
            text.remove_prefix(length);
        }
        return out += text;
    }

    [[nodiscard]] std::vector<std::string> names() const {
        std::vector<std::string> all;
        for (const auto& [name, value] : values_)
            if (used_.contains(name) || !overrides_.contains(name)) all.push_back(name);
        return all;
    }

    const SceneParameters& overrides_;
    std::map<std::string, std::string> values_;
    std::set<std::string> used_;
    SearchPath search_;
};

}  // namespace

XmlDocument read_xml(const std::filesystem::path& file, const SceneParameters& overrides) {
    return Reader(overrides, file.parent_path()).read_main(file);
}

}  // namespace koksma::loader
