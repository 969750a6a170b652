#include "ply_header.h"

#include "fail.h"
#include "numbers.h"

#include <optional>

namespace koksma::loader {
namespace {

std::vector<std::string> words(std::string_view line) {
    std::vector<std::string> out;
    for (line = trimmed(line); !line.empty(); line = trimmed(line)) {
        const auto end = line.find_first_of(" \t");
        out.emplace_back(line.substr(0, end));
        line.remove_prefix(end == std::string_view::npos ? line.size() : end);
    }
    return out;
}

PlyType parse_type(const std::string& name, const SourceLocation& where) {
    if (name == "char" || name == "int8") return PlyType::int8;
    if (name == "uchar" || name == "uint8") return PlyType::uint8;
    if (name == "short" || name == "int16") return PlyType::int16;
    if (name == "ushort" || name == "uint16") return PlyType::uint16;
    if (name == "int" || name == "int32") return PlyType::int32;
    if (name == "uint" || name == "uint32") return PlyType::uint32;
    if (name == "float" || name == "float32") return PlyType::float32;
    if (name == "double" || name == "float64") return PlyType::float64;
    fail(where, "'{}' is not a PLY type; supported: char, uchar, short, ushort, int, uint, float, double, int8 ... float64", name);
}

PlyFormat parse_format(const std::vector<std::string>& w, const SourceLocation& where) {
    if (w.size() == 3 && w[2] == "1.0") {
        if (w[1] == "ascii") return PlyFormat::ascii;
        if (w[1] == "binary_little_endian") return PlyFormat::little_endian;
        if (w[1] == "binary_big_endian") return PlyFormat::big_endian;
    }
    fail(where, "this PLY format is not supported; supported: ascii, binary_little_endian or binary_big_endian, 1.0");
}

PlyProperty parse_property(const std::vector<std::string>& w, const SourceLocation& where) {
    if (w.size() == 5 && w[1] == "list") {
        const PlyProperty p{w[4], parse_type(w[3], where), true, parse_type(w[2], where)};
        if (p.count_type == PlyType::float32 || p.count_type == PlyType::float64) fail(where, "a list length cannot be a {}", w[2]);
        return p;
    }
    if (w.size() == 3) return {w[2], parse_type(w[1], where), false, {}};
    fail(where, "this property is not understood; expected 'property TYPE NAME' or 'property list TYPE TYPE NAME'");
}

}  // namespace

std::size_t size_of(PlyType type) noexcept {
    switch (type) {
        case PlyType::int8:
        case PlyType::uint8:
            return 1;
        case PlyType::int16:
        case PlyType::uint16:
            return 2;
        case PlyType::int32:
        case PlyType::uint32:
        case PlyType::float32:
            return 4;
        case PlyType::float64:
            return 8;
    }
    return 0;
}

PlyHeader parse_ply_header(std::string_view bytes, const std::filesystem::path& file) {
    PlyHeader header;
    SourceLocation where{file.string(), 0, 0};
    bool has_format = false;
    for (std::size_t at = 0;;) {
        ++where.line;
        const auto end = bytes.find('\n', at);
        if (end == std::string_view::npos) fail(where, "the PLY header does not end; expected 'end_header'");
        const auto w = words(bytes.substr(at, end - at));
        at = end + 1;
        if (where.line == 1) {
            if (w.size() != 1 || w[0] != "ply") fail(where, "this is not a PLY file; it must begin with a line 'ply'");
            continue;
        }
        if (w.empty() || w[0] == "comment" || w[0] == "obj_info") continue;
        if (w[0] == "end_header") {
            header.body = at;
            header.body_line = where.line + 1;
            break;
        }
        if (w[0] == "format") {
            header.format = parse_format(w, where);
            has_format = true;
        } else if (w[0] == "element") {
            const auto count = w.size() == 3 ? parse_int64(w[2]) : std::nullopt;
            if (!count || *count < 0) fail(where, "this element is not understood; expected 'element NAME COUNT'");
            header.elements.push_back({w[1], static_cast<std::size_t>(*count), {}});
        } else if (w[0] == "property") {
            if (header.elements.empty()) fail(where, "a property before the first element");
            header.elements.back().properties.push_back(parse_property(w, where));
        } else {
            fail(where, "'{}' is not understood; expected format, comment, element, property or end_header", w[0]);
        }
    }
    if (!has_format) fail(where, "the PLY header has no 'format' line");
    return header;
}

}  // namespace koksma::loader
