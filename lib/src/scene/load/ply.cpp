// PLY meshes, ascii and binary, from one block of memory.

#include "fail.h"
#include "files.h"
#include "mesh.h"
#include "numbers.h"
#include "ply_header.h"

#include <koksma/scene/load.h>

#include <algorithm>
#include <bit>
#include <charconv>
#include <cstring>
#include <limits>

namespace koksma {
namespace loader {
namespace {

template <class T>
double as_double(const char* bytes, bool swap) {
    char raw[sizeof(T)];
    std::memcpy(raw, bytes, sizeof(T));
    if (swap) std::reverse(raw, raw + sizeof(T));
    T value;
    std::memcpy(&value, raw, sizeof(T));
    return static_cast<double>(value);
}

/// Takes one value after the other. Every 8-, 16- and 32-bit integer is a double exactly.
class BinaryCursor {
public:
    BinaryCursor(std::string_view bytes, bool big_endian, std::string file)
        : bytes_(bytes), swap_(big_endian != (std::endian::native == std::endian::big)), file_(std::move(file)) {}

    double next(PlyType type) {
        const std::size_t n = size_of(type);
        if (bytes_.size() < n) throw Error(file_ + ": the file ends before its data does");
        const char* at = bytes_.data();
        bytes_.remove_prefix(n);
        switch (type) {
            case PlyType::int8:
                return as_double<std::int8_t>(at, swap_);
            case PlyType::uint8:
                return as_double<std::uint8_t>(at, swap_);
            case PlyType::int16:
                return as_double<std::int16_t>(at, swap_);
            case PlyType::uint16:
                return as_double<std::uint16_t>(at, swap_);
            case PlyType::int32:
                return as_double<std::int32_t>(at, swap_);
            case PlyType::uint32:
                return as_double<std::uint32_t>(at, swap_);
            case PlyType::float32:
                return as_double<float>(at, swap_);
            case PlyType::float64:
                return as_double<double>(at, swap_);
        }
        return 0.0;
    }
    void finish() const {
        if (!bytes_.empty()) throw Error(fmt::format("{}: {} bytes follow the data that the header announces", file_, bytes_.size()));
    }
    [[nodiscard]] std::size_t remaining_values() const noexcept { return bytes_.size(); }

private:
    std::string_view bytes_;
    bool swap_;
    std::string file_;
};

class AsciiCursor {
public:
    AsciiCursor(std::string_view bytes, int line, std::string file) : bytes_(bytes), where_{std::move(file), line, 0} {}

    double next(PlyType type) {
        skip_blanks();
        if (bytes_.empty()) fail(where_, "the file ends before its data does");
        const auto end = std::min(bytes_.find_first_of(" \t\r\n"), bytes_.size());
        const std::string_view word = bytes_.substr(0, end);
        bytes_.remove_prefix(end);
        const bool real = type == PlyType::float32 || type == PlyType::float64;
        if (const auto v = real ? parse_double(word) : std::optional<double>{}) return *v;
        if (const auto v = real ? std::optional<std::int64_t>{} : parse_int64(word)) return static_cast<double>(*v);
        fail(where_, "'{}' is not {}", word, real ? "a number" : "an integer");
    }
    void finish() {
        skip_blanks();
        if (!bytes_.empty()) fail(where_, "there is more than the data that the header announces");
    }
    [[nodiscard]] std::size_t remaining_values() const noexcept { return bytes_.size(); }

private:
    void skip_blanks() {
        std::size_t i = 0;
        for (; i < bytes_.size() && (bytes_[i] == ' ' || bytes_[i] == '\t' || bytes_[i] == '\r' || bytes_[i] == '\n'); ++i)
            where_.line += bytes_[i] == '\n';
        bytes_.remove_prefix(i);
    }
    std::string_view bytes_;
    SourceLocation where_;
};

/// Where each value of a vertex goes: 0-2 position, 3-5 normal, 6-7 uv, 8 nowhere.
constexpr std::size_t kUnused = 8;
std::size_t vertex_slot(const std::string& name) {
    constexpr std::string_view kNames[] = {"x", "y", "z", "nx", "ny", "nz", "u", "v", "s", "t"};
    const auto i = static_cast<std::size_t>(std::find(std::begin(kNames), std::end(kNames), name) - std::begin(kNames));
    return i < 8 ? i : i < 10 ? i - 2 : kUnused;
}

std::size_t list_length(double n, const std::string& file) {
    if (n < 0.0) throw Error(fmt::format("{}: a list has length {}", file, n));
    return static_cast<std::size_t>(n);
}

template <class Cursor>
void skip(Cursor& cursor, const PlyProperty& p, const std::string& file) {
    const std::size_t n = p.is_list ? list_length(cursor.next(p.count_type), file) : 1;
    for (std::size_t k = 0; k < n; ++k) (void)cursor.next(p.type);
}

template <class Cursor>
void read_vertices(Cursor& cursor, const PlyElement& element, const std::string& file, MeshData& out) {
    std::vector<std::size_t> slots;
    bool has[9] = {};
    for (const PlyProperty& p : element.properties) {
        const std::size_t slot = p.is_list ? kUnused : vertex_slot(p.name);
        if (slot != kUnused && has[slot]) throw Error(fmt::format("{}: vertices have '{}' twice", file, p.name));
        has[slot] = true;
        slots.push_back(slot);
    }
    const bool positions = has[0] && has[1] && has[2], normals = has[3] && has[4] && has[5], uvs = has[6] && has[7];
    if (!positions) throw Error(file + ": vertices need the properties x, y and z");
    if (normals != (has[3] || has[4] || has[5]) || uvs != (has[6] || has[7]))
        throw Error(file + ": vertices have a part of nx, ny, nz or of u, v (s, t); all or none must be there");
    if (element.count > cursor.remaining_values()) throw Error(file + ": the file is too short for the vertices that its header announces");
    out.positions.reserve(element.count);
    if (normals) out.normals.reserve(element.count);
    if (uvs) out.uvs.reserve(element.count);
    float v[9] = {};
    for (std::size_t i = 0; i < element.count; ++i) {
        for (std::size_t k = 0; k < slots.size(); ++k) {
            if (element.properties[k].is_list)
                skip(cursor, element.properties[k], file);
            else
                v[slots[k]] = static_cast<float>(cursor.next(element.properties[k].type));
        }
        out.positions.emplace_back(v[0], v[1], v[2]);
        if (normals) out.normals.emplace_back(v[3], v[4], v[5]);
        if (uvs) out.uvs.emplace_back(v[6], v[7]);
    }
}

template <class Cursor>
void read_face(Cursor& cursor, const PlyProperty& list, std::size_t face, const std::string& file, MeshData& out) {
    const std::size_t n = list_length(cursor.next(list.count_type), file);
    if (n < 3) throw Error(fmt::format("{}: face {} has {} corners; expected at least 3", file, face, n));
    std::uint32_t first = 0, previous = 0;
    for (std::size_t k = 0; k < n; ++k) {
        const double index = cursor.next(list.type);
        if (!(index >= 0.0 && index < static_cast<double>(out.positions.size())))
            throw Error(fmt::format("{}: face {} uses vertex {}; there are {} (from 0)", file, face, index, out.positions.size()));
        const auto v = static_cast<std::uint32_t>(index);
        if (k >= 2) out.triangles.push_back({first, previous, v});
        if (k == 0) first = v;
        previous = v;
    }
}

template <class Cursor>
void read_faces(Cursor& cursor, const PlyElement& element, const std::string& file, MeshData& out) {
    const auto is_indices = [](const PlyProperty& p) { return p.is_list && (p.name == "vertex_indices" || p.name == "vertex_index"); };
    if (std::none_of(element.properties.begin(), element.properties.end(), is_indices))
        throw Error(file + ": faces need a list 'vertex_indices' (or 'vertex_index')");
    if (element.count > cursor.remaining_values()) throw Error(file + ": the file is too short for the faces that its header announces");
    out.triangles.reserve(element.count);
    for (std::size_t i = 0; i < element.count; ++i)
        for (const PlyProperty& p : element.properties) {
            if (is_indices(p))
                read_face(cursor, p, i, file, out);
            else
                skip(cursor, p, file);
        }
}

template <class Cursor>
MeshData read_body(Cursor cursor, const PlyHeader& header, const std::string& file) {
    MeshData out;
    for (const PlyElement& element : header.elements) {
        if (element.name == "vertex") {
            if (!out.positions.empty()) throw Error(file + ": 'element vertex' is there twice");
            if (element.count > std::numeric_limits<std::uint32_t>::max())
                throw Error(file + ": more than 2^32 vertices are not supported");
            read_vertices(cursor, element, file, out);
        } else if (element.name == "face") {
            read_faces(cursor, element, file, out);
        } else if (!element.properties.empty()) {  // without properties nothing bounds the count
            for (std::size_t i = 0; i < element.count; ++i)
                for (const PlyProperty& p : element.properties) skip(cursor, p, file);
        }
    }
    cursor.finish();
    return out;
}

}  // namespace
}  // namespace loader

MeshData load_ply(const std::filesystem::path& file) {
    using namespace loader;
    const std::string bytes = read_file(file);
    const PlyHeader header = parse_ply_header(bytes, file);
    const std::string_view body = std::string_view(bytes).substr(header.body);
    const std::string name = file.string();
    MeshData mesh = header.format == PlyFormat::ascii
                        ? read_body(AsciiCursor(body, header.body_line, name), header, name)
                        : read_body(BinaryCursor(body, header.format == PlyFormat::big_endian, name), header, name);
    check_mesh(mesh, file);
    return mesh;
}

}  // namespace koksma
