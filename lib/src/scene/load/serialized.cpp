// Mitsuba's .serialized meshes: a header of two numbers, then one zlib stream a mesh, then a table of where they begin.

#include "fail.h"
#include "files.h"
#include "mesh.h"

#include <koksma/scene/load.h>

#include <zlib.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>

namespace koksma {
namespace loader {
namespace {

static_assert(std::endian::native == std::endian::little, "the format is little endian, and read as it lies");

enum Flags : std::uint32_t { kNormals = 0x1, kUvs = 0x2, kTangents = 0x4, kColors = 0x8, kFaceNormals = 0x10, kSingle = 0x1000, kDouble = 0x2000 };

template <class T>
T value_at(std::string_view bytes, std::size_t offset, const std::string& file) {
    if (offset > bytes.size() || bytes.size() - offset < sizeof(T)) throw Error(file + ": the file ends before its data does");
    T value;
    std::memcpy(&value, bytes.data() + offset, sizeof(T));
    return value;
}

/// Inflates as much as is asked for, so that a small file that claims to be large takes no memory.
class Inflater {
public:
    Inflater(std::string_view bytes, const std::string& file) : file_(file) {
        stream_.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(bytes.data()));
        stream_.avail_in = static_cast<uInt>(std::min<std::size_t>(bytes.size(), ~uInt{0}));
        if (inflateInit(&stream_) != Z_OK) throw Error(file + ": zlib cannot start");
    }
    ~Inflater() { inflateEnd(&stream_); }
    Inflater(const Inflater&) = delete;
    Inflater& operator=(const Inflater&) = delete;

    void read(void* to, std::size_t size) {
        stream_.next_out = static_cast<Bytef*>(to);
        while (size > 0) {
            stream_.avail_out = static_cast<uInt>(std::min<std::size_t>(size, std::size_t{1} << 30));
            const std::size_t asked = stream_.avail_out;
            const int result = inflate(&stream_, Z_NO_FLUSH);
            const std::size_t got = asked - stream_.avail_out;
            size -= got;
            if (size == 0) return;
            if (result == Z_STREAM_END) throw Error(file_ + ": the mesh ends before its data does");
            if (result != Z_OK || got == 0) throw Error(fmt::format("{}: the compressed data is damaged ({})", file_, stream_.msg ? stream_.msg : "it ends too early"));
        }
    }
    template <class T>
    T value() {
        T v;
        read(&v, sizeof v);
        return v;
    }
    /// `count` values of `size` bytes, in blocks: memory grows with what is really there.
    template <class T>
    std::vector<T> values(std::size_t count) {
        std::vector<T> out;
        constexpr std::size_t kBlock = 1 << 18;
        while (out.size() < count) {
            const std::size_t n = std::min(kBlock, count - out.size());
            if (out.size() + n > out.capacity()) out.reserve(std::min(count, std::max(out.size() + n, 2 * out.size())));
            out.resize(out.size() + n);
            read(out.data() + out.size() - n, n * sizeof(T));
        }
        return out;
    }

private:
    z_stream stream_{};
    const std::string& file_;
};

/// Vectors of N numbers, in single or double precision.
template <int N>
std::vector<glm::vec<N, float>> vectors(Inflater& in, std::size_t count, bool doubles) {
    if (!doubles) return in.values<glm::vec<N, float>>(count);
    std::vector<glm::vec<N, float>> out;
    for (const auto& v : in.values<glm::vec<N, double>>(count)) out.emplace_back(v);
    return out;
}

/// Where a mesh begins. @throws Error if there is none of this index
std::size_t offset_of(std::string_view bytes, std::uint32_t index, bool wide, const std::string& file) {
    if (index == 0) return 0;
    const auto count = value_at<std::uint32_t>(bytes, bytes.size() < 4 ? bytes.size() : bytes.size() - 4, file);
    if (index >= count) throw Error(fmt::format("{}: there is no mesh {}; the file has {} (from 0)", file, index, count));
    const std::size_t entry = wide ? 8 : 4, back = entry * (count - std::size_t{index}) + 4;
    if (back > bytes.size()) throw Error(file + ": the table of its meshes is damaged");
    const std::size_t at = bytes.size() - back;
    const std::uint64_t offset = wide ? value_at<std::uint64_t>(bytes, at, file) : value_at<std::uint32_t>(bytes, at, file);
    if (offset >= bytes.size()) throw Error(file + ": the table of its meshes is damaged");
    return static_cast<std::size_t>(offset);
}

MeshData read_mesh(Inflater& in, bool named, const std::string& file) {
    const auto flags = in.value<std::uint32_t>();
    if (named)
        while (in.value<char>() != 0) {}
    const auto vertices = in.value<std::uint64_t>(), triangles = in.value<std::uint64_t>();
    if (vertices > 0xffffffffu || triangles > 0x7fffffffu)
        throw Error(fmt::format("{}: {} vertices and {} triangles; at most 2^32 and 2^31 are supported", file, vertices, triangles));
    if ((flags & kTangents) != 0) throw Error(file + ": tangents are not supported");
    if (((flags & kSingle) != 0) == ((flags & kDouble) != 0)) throw Error(file + ": the mesh is neither in single nor in double precision");
    const bool doubles = (flags & kDouble) != 0;
    const auto n = static_cast<std::size_t>(vertices);
    MeshData mesh;
    mesh.positions = vectors<3>(in, n, doubles);
    if ((flags & kNormals) != 0) mesh.normals = vectors<3>(in, n, doubles);
    if ((flags & kUvs) != 0) mesh.uvs = vectors<2>(in, n, doubles);
    if ((flags & kColors) != 0) mesh.attributes.push_back({"vertex_color", vectors<3>(in, n, doubles)});
    mesh.triangles = in.values<std::array<std::uint32_t, 3>>(static_cast<std::size_t>(triangles));
    if ((flags & kFaceNormals) != 0) mesh.faceted = true;
    return mesh;
}

}  // namespace
}  // namespace loader

MeshData load_serialized(const std::filesystem::path& file, std::uint32_t index) {
    using namespace loader;
    const std::string bytes = read_file(file), name = file.string();
    const auto version = value_at<std::uint16_t>(bytes, 2, name);
    if (value_at<std::uint16_t>(bytes, 0, name) != 0x041C) throw Error(name + ": this is not a serialized mesh");
    if (version != 3 && version != 4) throw Error(fmt::format("{}: version {} of the format is not supported; supported: 3, 4", name, version));
    const std::size_t offset = offset_of(bytes, index, version == 4, name);
    if (value_at<std::uint16_t>(bytes, offset, name) != 0x041C) throw Error(name + ": the table of its meshes is damaged");
    Inflater in(std::string_view(bytes).substr(std::min(offset + 4, bytes.size())), name);
    MeshData mesh = read_mesh(in, version == 4, name);
    check_mesh(mesh, file);
    return mesh;
}

}  // namespace koksma
