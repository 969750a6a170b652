// Wavefront OBJ by tinyobjloader, which reads a number it does not understand as 0: so every line is looked at first.

#include "fail.h"
#include "files.h"
#include "mesh.h"
#include "numbers.h"

#include <koksma/scene/load.h>

#include <tiny_obj_loader.h>

#include <array>
#include <sstream>
#include <unordered_map>

namespace koksma {
namespace loader {
namespace {

std::string_view next_word(std::string_view& line) {
    line = trimmed(line);
    const auto end = line.find_first_of(" \t");
    const std::string_view word = line.substr(0, end);
    line.remove_prefix(end == std::string_view::npos ? line.size() : end);
    return word;
}

struct Counts {
    std::size_t v = 0, vt = 0, vn = 0;
};

void check_numbers(std::string_view rest, std::string_view keyword, std::size_t least, std::size_t number, const SourceLocation& where) {
    std::size_t found = 0;
    for (std::string_view word = next_word(rest); !word.empty(); word = next_word(rest), ++found) {
        const auto value = parse_double(word);
        if (!value) fail(where, "'{}' is not a number ({} {})", word, keyword, number);
        if (!finite_float(*value)) fail(where, "{} {} has {}; it must be finite", keyword == "v" ? "vertex" : keyword, number, word);
    }
    if (found < least) fail(where, "{} {} has {} numbers; expected {}", keyword, number, found, least);
}

/// "v", "v/vt", "v//vn" or "v/vt/vn", each positive or (from the end) negative.
void check_corner(std::string_view corner, const Counts& n, const SourceLocation& where) {
    const std::array<std::size_t, 3> counts{n.v, n.vt, n.vn};
    const std::string_view whole = corner;
    for (std::size_t k = 0;; ++k) {
        if (k == 3) fail(where, "'{}' is not a corner of a face; expected v, v/vt, v//vn or v/vt/vn", whole);
        const auto slash = corner.find('/');
        const std::string_view index = corner.substr(0, slash);
        if (!(index.empty() && k == 1 && slash != std::string_view::npos)) {
            const auto value = parse_int64(index);
            if (!value) fail(where, "'{}' is not a corner of a face; expected v, v/vt, v//vn or v/vt/vn", whole);
            const auto count = static_cast<std::int64_t>(counts[k]);
            if (*value == 0 || *value > count || *value < -count)
                fail(where, "'{}' in a face is out of range: there are {} {} before it", whole, count, k == 0 ? "v" : k == 1 ? "vt" : "vn");
        }
        if (slash == std::string_view::npos) return;
        corner.remove_prefix(slash + 1);
    }
}

/// @throws Error file:line for every line that would be misread or skipped
void check_lines(std::string_view text, const std::string& file) {
    Counts n;
    SourceLocation where{file, 0, 0};
    while (!text.empty()) {
        ++where.line;
        const auto end = text.find('\n');
        std::string_view rest = text.substr(0, end);
        text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
        const std::string_view keyword = next_word(rest);
        if (keyword.empty() || keyword.starts_with('#')) continue;
        if (keyword == "v")
            check_numbers(rest, keyword, 3, n.v++, where);
        else if (keyword == "vt")
            check_numbers(rest, keyword, 2, n.vt++, where);
        else if (keyword == "vn")
            check_numbers(rest, keyword, 3, n.vn++, where);
        else if (keyword == "f") {
            std::size_t corners = 0;
            for (std::string_view c = next_word(rest); !c.empty(); c = next_word(rest), ++corners) check_corner(c, n, where);
            if (corners < 3) fail(where, "a face has {} corners; expected at least 3", corners);
        } else if (keyword != "o" && keyword != "g" && keyword != "s" && keyword != "usemtl" && keyword != "mtllib")
            fail(where, "'{}' is not supported; supported: v, vt, vn, f (o, g, s, usemtl and mtllib are ignored)", keyword);
    }
}

struct IndexHash {
    std::size_t operator()(const std::array<int, 3>& i) const noexcept {
        std::uint64_t h = 0;
        for (const int k : i) h = (h ^ static_cast<std::uint32_t>(k)) * 0x9E3779B97F4A7C15u, h ^= h >> 32;  // golden-ratio multiplier
        return static_cast<std::size_t>(h);
    }
};

/// One vertex per distinct (position, uv, normal), in order of first use: Mitsuba's vertices, so its computed normals agree too.
class Assembler {
public:
    Assembler(const tinyobj::attrib_t& attributes, const std::string& file) : in_(attributes), file_(file) {}

    void add(const tinyobj::mesh_t& faces) {
        std::size_t first = 0;
        for (const auto corners : faces.num_face_vertices) {
            std::uint32_t fan[2] = {0, 0};
            for (std::size_t k = 0; k < corners; ++k) {
                const std::uint32_t v = vertex(faces.indices[first + k]);
                if (k >= 2) out.triangles.push_back({fan[0], fan[1], v});
                if (k == 0) fan[0] = v;
                fan[1] = v;
            }
            first += corners;
        }
    }

    MeshData out;

private:
    std::uint32_t vertex(const tinyobj::index_t& i) {
        const auto [it, is_new] =
            seen_.try_emplace({i.vertex_index, i.texcoord_index, i.normal_index}, static_cast<std::uint32_t>(out.positions.size()));
        if (!is_new) return it->second;
        const auto at = [](const std::vector<tinyobj::real_t>& values, int index, int stride, int k) {
            return static_cast<float>(
                values[static_cast<std::size_t>(index) * static_cast<std::size_t>(stride) + static_cast<std::size_t>(k)]);
        };
        const auto point = [&](const std::vector<tinyobj::real_t>& values, int index) {
            return glm::vec3(at(values, index, 3, 0), at(values, index, 3, 1), at(values, index, 3, 2));
        };
        out.positions.push_back(point(in_.vertices, i.vertex_index));
        if (i.normal_index >= 0) out.normals.push_back(point(in_.normals, i.normal_index));
        if (i.texcoord_index >= 0)
            out.uvs.emplace_back(at(in_.texcoords, i.texcoord_index, 2, 0), at(in_.texcoords, i.texcoord_index, 2, 1));
        const std::size_t n = out.positions.size();
        if ((!out.normals.empty() && out.normals.size() != n) || (!out.uvs.empty() && out.uvs.size() != n))
            throw Error(file_ + ": some faces have normals or texture coordinates and others have none; all or none must have them");
        return it->second;
    }

    const tinyobj::attrib_t& in_;
    const std::string& file_;
    std::unordered_map<std::array<int, 3>, std::uint32_t, IndexHash> seen_;
};

}  // namespace
}  // namespace loader

MeshData load_obj(const std::filesystem::path& file) {
    using namespace loader;
    std::string text = read_file(file);
    const std::string name = file.string();
    check_lines(text, name);

    tinyobj::attrib_t attributes;
    std::vector<tinyobj::shape_t> shapes;
    std::vector<tinyobj::material_t> materials;
    std::string warnings, errors;
    std::istringstream stream(std::move(text));
    if (!tinyobj::LoadObj(&attributes, &shapes, &materials, &warnings, &errors, &stream, nullptr, /*triangulate=*/false))
        throw Error(name + ": " + std::string(trimmed(errors)));

    Assembler assembler(attributes, name);
    for (const auto& shape : shapes) assembler.add(shape.mesh);
    check_mesh(assembler.out, file);
    return std::move(assembler.out);
}

}  // namespace koksma
