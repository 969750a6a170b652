// PLY meshes, ascii and binary, from one block of memory.

#include "fail.h"
#include "files.h"
#include "mesh.h"
#include "numbers.h"
#include "ply_header.h"

#include <koksma/scene/load.h>

#include <algorithm>
#include <array>
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
    [[nodiscard]] static std::size_t least_size(const PlyProperty& p) noexcept { return size_of(p.is_list ? p.count_type : p.type); }
    /// All of `count` records at once.
    const char* take(std::size_t record, std::size_t count) {
        if (record > 0 && bytes_.size() / record < count) throw Error(file_ + ": the file ends before its data does");
        const char* at = bytes_.data();
        bytes_.remove_prefix(record * count);
        return at;
    }
    [[nodiscard]] bool swaps() const noexcept { return swap_; }
    [[nodiscard]] std::string_view rest() const noexcept { return bytes_; }

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
    [[nodiscard]] std::size_t remaining_values() const noexcept { return bytes_.size() + 1; }
    [[nodiscard]] static std::size_t least_size(const PlyProperty&) noexcept { return 2; }  // a digit and a blank

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

std::size_t list_length(double n, const std::string& file) {
    if (n < 0.0) throw Error(fmt::format("{}: a list has length {}", file, n));
    return static_cast<std::size_t>(n);
}

template <class Cursor>
void skip(Cursor& cursor, const PlyProperty& p, const std::string& file) {
    const std::size_t n = p.is_list ? list_length(cursor.next(p.count_type), file) : 1;
    for (std::size_t k = 0; k < n; ++k) (void)cursor.next(p.type);
}

/// False if a file cannot hold the records that its header announces: asked before memory is taken for them.
template <class Cursor>
bool has_room(const Cursor& cursor, const PlyElement& element) {
    std::size_t record = 0;
    for (const PlyProperty& p : element.properties) record += Cursor::least_size(p);
    return record == 0 || element.count <= cursor.remaining_values() / record;
}

/// Where the values of one property go: one float a vertex (or face), so far apart; nowhere if null.
struct Target {
    float* to = nullptr;
    std::size_t stride = 0;
};

/// Vertices and faces may bring values besides: names that end in _0 _1 _2, _x _y _z or _r _g _b (or are r g b), one or three of
/// them, as Mitsuba reads them. What is named otherwise is skipped, as there.
std::vector<Target> attribute_targets(const PlyElement& element, const std::string& prefix, std::size_t first_new, MeshData& out) {
    struct Group {
        std::string name;
        std::vector<std::size_t> properties;
    };
    std::vector<Group> groups;
    for (std::size_t k = 0; k < element.properties.size(); ++k) {
        const PlyProperty& p = element.properties[k];
        constexpr std::string_view kPlain[] = {"x", "y", "z", "nx", "ny", "nz", "u", "v", "s", "t"};
        if (p.is_list || std::find(std::begin(kPlain), std::end(kPlain), p.name) != std::end(kPlain)) continue;
        std::string name = p.name, postfix = p.name;
        if (name == "red" || name == "green" || name == "blue" || name == "r" || name == "g" || name == "b") {
            name = "color";
            postfix = postfix.substr(0, 1);
        } else {
            const auto underscore = name.rfind('_');
            if (underscore == std::string::npos) continue;
            postfix = name.substr(underscore + 1);
            name.resize(underscore);
            if (postfix == "r" || postfix == "g" || postfix == "b") name += "_color";
        }
        const bool goes_on = !groups.empty() && groups.back().name == name && groups.back().properties.back() + 1 == k;
        const std::size_t place = goes_on ? groups.back().properties.size() : 0;
        constexpr std::string_view kOrders[] = {"0123", "xyzw", "rgba"};
        if (place > 3 || postfix.size() != 1 || std::none_of(std::begin(kOrders), std::end(kOrders), [&](std::string_view o) { return o[place] == postfix[0]; }))
            continue;
        if (!goes_on) groups.push_back({name, {}});
        groups.back().properties.push_back(k);
    }
    std::vector<Target> targets(element.properties.size());
    for (const Group& group : groups) {
        if (group.properties.size() != 1 && group.properties.size() != 3) continue;
        MeshAttribute attribute{prefix + group.name, {}};
        const auto same = [&](const MeshAttribute& a) { return a.name == attribute.name; };
        if (std::any_of(out.attributes.begin() + static_cast<std::ptrdiff_t>(first_new), out.attributes.end(), same)) continue;
        attribute.values.resize(element.count);
        for (std::size_t i = 0; i < group.properties.size() && element.count > 0; ++i) targets[group.properties[i]] = {&attribute.values[0][static_cast<int>(i)], 3};
        out.attributes.push_back(std::move(attribute));  // the values stay where they are
    }
    return targets;
}

/// One number is a grey.
void spread_greys(const PlyElement& element, const std::vector<Target>& targets, MeshData& out) {
    for (MeshAttribute& a : out.attributes) {
        const auto uses = [&](int i) {
            return !a.values.empty() && std::any_of(targets.begin(), targets.end(), [&](const Target& t) { return t.to == &a.values[0][i]; });
        };
        if (a.values.size() == element.count && uses(0) && !uses(1))
            for (Rgb& v : a.values) v = Rgb(v.r);
    }
}

/// Reads one property of all records at once: T is known outside the loop.
template <class T>
void read_column(const char* from, std::size_t record, std::size_t count, bool swap, Target target) {
    for (std::size_t i = 0; i < count; ++i) {
        char raw[sizeof(T)];
        std::memcpy(raw, from + i * record, sizeof(T));
        if (swap) std::reverse(raw, raw + sizeof(T));
        T value;
        std::memcpy(&value, raw, sizeof(T));
        target.to[i * target.stride] = static_cast<float>(value);
    }
}

void read_column(PlyType type, const char* from, std::size_t record, std::size_t count, bool swap, Target target) {
    switch (type) {
        case PlyType::int8: return read_column<std::int8_t>(from, record, count, swap, target);
        case PlyType::uint8: return read_column<std::uint8_t>(from, record, count, swap, target);
        case PlyType::int16: return read_column<std::int16_t>(from, record, count, swap, target);
        case PlyType::uint16: return read_column<std::uint16_t>(from, record, count, swap, target);
        case PlyType::int32: return read_column<std::int32_t>(from, record, count, swap, target);
        case PlyType::uint32: return read_column<std::uint32_t>(from, record, count, swap, target);
        case PlyType::float32: return read_column<float>(from, record, count, swap, target);
        case PlyType::float64: return read_column<double>(from, record, count, swap, target);
    }
}

/// Records of one size are read column by column. @return  false if there are lists among the properties
bool read_columns(BinaryCursor& cursor, const PlyElement& element, const std::vector<Target>& targets) {
    std::size_t record = 0;
    for (const PlyProperty& p : element.properties) {
        if (p.is_list) return false;
        record += size_of(p.type);
    }
    const char* from = cursor.take(record, element.count);
    for (std::size_t k = 0; k < targets.size(); ++k) {
        if (targets[k].to) read_column(element.properties[k].type, from, record, element.count, cursor.swaps(), targets[k]);
        from += size_of(element.properties[k].type);
    }
    return true;
}
bool read_columns(AsciiCursor&, const PlyElement&, const std::vector<Target>&) { return false; }

template <class Cursor>
void read_records(Cursor& cursor, const PlyElement& element, const std::vector<Target>& targets, const std::string& file) {
    if (read_columns(cursor, element, targets)) return;
    for (std::size_t i = 0; i < element.count; ++i)
        for (std::size_t k = 0; k < targets.size(); ++k) {
            if (element.properties[k].is_list)
                skip(cursor, element.properties[k], file);
            else if (const auto value = static_cast<float>(cursor.next(element.properties[k].type)); targets[k].to)
                targets[k].to[i * targets[k].stride] = value;
        }
}

template <class Cursor>
void read_vertices(Cursor& cursor, const PlyElement& element, const std::string& file, MeshData& out) {
    const auto index_of = [&](std::string_view name) {
        std::size_t found = element.properties.size();
        for (std::size_t k = 0; k < element.properties.size(); ++k) {
            if (element.properties[k].is_list || element.properties[k].name != name) continue;
            if (found != element.properties.size()) throw Error(fmt::format("{}: vertices have '{}' twice", file, name));
            found = k;
        }
        return found;
    };
    if (!has_room(cursor, element)) throw Error(file + ": the file is too short for the vertices that its header announces");
    const std::size_t none = element.properties.size();
    const std::size_t at[] = {index_of("x"), index_of("y"), index_of("z"), index_of("nx"), index_of("ny"), index_of("nz")};
    const std::size_t u = index_of("u"), v = index_of("v"), s = index_of("s"), t = index_of("t");
    const std::size_t uv[] = {u != none ? u : s, v != none ? v : t};
    const auto has = [&](std::size_t first, std::size_t count, const std::size_t* where) {
        std::size_t found = 0;
        for (std::size_t i = first; i < first + count; ++i) found += where[i] != none;
        return found;
    };
    if (has(0, 3, at) != 3) throw Error(file + ": vertices need the properties x, y and z");
    if (has(3, 3, at) % 3 != 0 || has(0, 2, uv) % 2 != 0)
        throw Error(file + ": vertices have a part of nx, ny, nz or of u, v (s, t); all or none must be there");
    if ((u != none && s != none) || (v != none && t != none)) throw Error(file + ": vertices have texture coordinates twice: u, v and s, t");
    std::vector<Target> targets = attribute_targets(element, "vertex_", out.attributes.size(), out);
    out.positions.resize(element.count);
    if (has(3, 3, at) != 0) out.normals.resize(element.count);
    if (has(0, 2, uv) != 0) out.uvs.resize(element.count);
    for (int i = 0; i < 3 && element.count > 0; ++i) {
        targets[at[i]] = {&out.positions[0][i], 3};
        if (!out.normals.empty()) targets[at[3 + i]] = {&out.normals[0][i], 3};
        if (i < 2 && !out.uvs.empty()) targets[uv[i]] = {&out.uvs[0][i], 2};
    }
    read_records(cursor, element, targets, file);
    spread_greys(element, targets, out);
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

/// As long as faces are nothing but triangles of 32-bit indices in the machine's own byte order, they are copied.
/// @return  number of faces read
std::size_t read_triangles(BinaryCursor& cursor, const PlyElement& element, MeshData& out) {
    if (element.properties.size() != 1 || cursor.swaps()) return 0;
    const PlyProperty& p = element.properties[0];
    const bool wanted = (p.type == PlyType::int32 || p.type == PlyType::uint32) && (p.count_type == PlyType::uint8 || p.count_type == PlyType::int8);
    if (!wanted) return 0;
    constexpr std::size_t kRecord = 13;
    const std::string_view bytes = cursor.rest();
    const std::size_t most = std::min(element.count, bytes.size() / kRecord), vertices = out.positions.size();
    out.triangles.resize(most);
    std::size_t n = 0;
    for (; n < most && bytes[n * kRecord] == 3; ++n) {
        std::array<std::uint32_t, 3>& t = out.triangles[n];
        std::memcpy(t.data(), bytes.data() + n * kRecord + 1, sizeof t);
        if (t[0] >= vertices || t[1] >= vertices || t[2] >= vertices) break;  // read_face says what is wrong
    }
    out.triangles.resize(n);
    (void)cursor.take(kRecord, n);
    return n;
}
std::size_t read_triangles(AsciiCursor&, const PlyElement&, MeshData&) { return 0; }

template <class Cursor>
void read_faces(Cursor& cursor, const PlyElement& element, const std::string& file, MeshData& out) {
    const auto is_indices = [](const PlyProperty& p) { return p.is_list && (p.name == "vertex_indices" || p.name == "vertex_index"); };
    if (std::none_of(element.properties.begin(), element.properties.end(), is_indices))
        throw Error(file + ": faces need a list 'vertex_indices' (or 'vertex_index')");
    if (!out.triangles.empty()) throw Error(file + ": 'element face' is there twice");
    if (!has_room(cursor, element)) throw Error(file + ": the file is too short for the faces that its header announces");
    std::size_t done = read_triangles(cursor, element, out);
    if (done == element.count) return;
    const std::vector<Target> targets = attribute_targets(element, "face_", out.attributes.size(), out);
    out.triangles.reserve(element.count);
    for (; done < element.count; ++done) {
        const std::size_t before = out.triangles.size();
        for (std::size_t k = 0; k < targets.size(); ++k) {
            const PlyProperty& p = element.properties[k];
            if (is_indices(p))
                read_face(cursor, p, done, file, out);
            else if (p.is_list || !targets[k].to)
                skip(cursor, p, file);
            else
                targets[k].to[done * targets[k].stride] = static_cast<float>(cursor.next(p.type));
        }
        if (out.triangles.size() != before + 1 && !out.attributes.empty() && out.attributes.back().per_face())
            throw Error(fmt::format("{}: face {} is no triangle; faces with attributes must be triangles", file, done));
    }
    spread_greys(element, targets, out);
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
