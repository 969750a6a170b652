// Meshes and images.

#include "scene_files.h"

#include <koksma/scene/scene.h>

#include <koksma_catch.h>

#include <zlib.h>

#include <array>
#include <sstream>

#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfOutputFile.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>

using namespace koksma;
using namespace koksma::testing;

#define CHECK_ERROR(expression, ...)              \
    do {                                          \
        const std::string message = (expression); \
        INFO(message);                            \
        CHECK(has(message, {__VA_ARGS__}));       \
    } while (false)

namespace {

const std::string kQuad = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 1\n";

std::string mesh_shape(const std::string& type, const std::string& file, const std::string& more = {}) {
    return "<shape type=\"" + type + "\"><string name=\"filename\" value=\"" + file + "\"/>" + more + "</shape>";
}
const MeshData& mesh_of(const SceneDescription& scene, std::size_t i = 0) { return *std::get<MeshShape>(scene.shapes.at(i).geometry).data; }

bool near(const glm::vec3& a, const glm::vec3& b) {
    return std::max({std::abs(a.x - b.x), std::abs(a.y - b.y), std::abs(a.z - b.z)}) < 1e-6f;
}

template <class T>
void put(std::string& out, T value, bool big) {
    char raw[sizeof(T)];
    std::memcpy(raw, &value, sizeof(T));
    if (big != (std::endian::native == std::endian::big)) std::reverse(raw, raw + sizeof(T));
    out.append(raw, sizeof(T));
}

/// A quad and a triangle with doubles, normals, uv, and properties and elements to skip.
std::string binary_ply(bool big) {
    std::string s =
        std::string("ply\nformat binary_") + (big ? "big" : "little") +
        "_endian 1.0\ncomment two faces\nelement vertex 4\nproperty double x\nproperty float y\nproperty float z\nproperty uchar red\n"
        "property float nx\nproperty float ny\nproperty float nz\nproperty float s\nproperty float t\n"
        "element face 2\nproperty uchar flags\nproperty list uchar int vertex_indices\n"
        "element edge 1\nproperty list ushort short ends\nend_header\n";
    const float xyz[4][3] = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0.5f}};
    for (const auto& v : xyz) {
        put(s, double(v[0]), big), put(s, v[1], big), put(s, v[2], big), put(s, std::uint8_t{7}, big);
        put(s, 0.0f, big), put(s, 0.0f, big), put(s, 1.0f, big), put(s, v[0], big), put(s, 0.25f, big);
    }
    put(s, std::uint8_t{9}, big), put(s, std::uint8_t{4}, big);
    for (const int i : {0, 1, 2, 3}) put(s, i, big);
    put(s, std::uint8_t{9}, big), put(s, std::uint8_t{3}, big);
    for (const int i : {3, 2, 1}) put(s, i, big);
    put(s, std::uint16_t{2}, big), put(s, std::int16_t{0}, big), put(s, std::int16_t{1}, big);
    return s;
}

std::string ascii_ply(const std::string& vertices, const std::string& faces, int vertex_count, int face_count) {
    return "ply\nformat ascii 1.0\nelement vertex " + std::to_string(vertex_count) +
           "\nproperty float x\nproperty float y\nproperty float z\nelement face " + std::to_string(face_count) +
           "\nproperty list uchar int vertex_index\nend_header\n" + vertices + faces;
}

void write_exr(const std::filesystem::path& file, std::vector<std::vector<float>> planes, const std::vector<std::string>& names, int width,
               int height) {
    Imf::Header header(width, height);
    Imf::FrameBuffer buffer;
    for (std::size_t i = 0; i < names.size(); ++i) {
        header.channels().insert(names[i], Imf::Channel(Imf::FLOAT));
        buffer.insert(names[i], Imf::Slice(Imf::FLOAT, reinterpret_cast<char*>(planes[i].data()), sizeof(float),
                                           sizeof(float) * static_cast<std::size_t>(width)));
    }
    Imf::OutputFile out(file.string().c_str(), header);
    out.setFrameBuffer(buffer);
    out.writePixels(height);
}

// A 2 x 2 PNG: red, green; blue, grey 128. Stored (not compressed) deflate block.
const unsigned char kPng[] = {0x89, 0x50, 0x4e, 0x47, 0x0d, 0x0a, 0x1a, 0x0a, 0x00, 0x00, 0x00, 0x0d, 0x49, 0x48, 0x44, 0x52, 0x00,
                              0x00, 0x00, 0x02, 0x00, 0x00, 0x00, 0x02, 0x08, 0x02, 0x00, 0x00, 0x00, 0xfd, 0xd4, 0x9a, 0x73, 0x00,
                              0x00, 0x00, 0x19, 0x49, 0x44, 0x41, 0x54, 0x78, 0x01, 0x01, 0x0e, 0x00, 0xf1, 0xff, 0x00, 0xff, 0x00,
                              0x00, 0x00, 0xff, 0x00, 0x00, 0x00, 0x00, 0xff, 0x80, 0x80, 0x80, 0x1c, 0xf4, 0x04, 0x7e, 0xc2, 0xc6,
                              0x4b, 0x45, 0x00, 0x00, 0x00, 0x00, 0x49, 0x45, 0x4e, 0x44, 0xae, 0x42, 0x60, 0x82};
const std::string kPngBytes(reinterpret_cast<const char*>(kPng), sizeof kPng);

}  // namespace

TEST_CASE("an OBJ has one vertex per distinct corner and fans for polygons", "[unit][scene]") {
    const SceneFiles files;
    const auto mesh = load_obj(files.write(
        "q.obj", kQuad + "vt 0 0\nvt 1 0\nvt 1 .75\nvt 0 .75\no part\ng x\ns 1\nusemtl m\nf 1/1 2/2 3/3 4/4\nf -4/1 3/3 -1/4\n"));
    REQUIRE(mesh.triangles.size() == 3);
    CHECK(mesh.positions.size() == 4);
    CHECK(mesh.triangles[1] == std::array<std::uint32_t, 3>{0, 2, 3});
    CHECK(mesh.triangles[2] == std::array<std::uint32_t, 3>{0, 2, 3});
    CHECK(mesh.uvs[2] == glm::vec2(1, 0.75f));
    CHECK(mesh.normals.empty());
}

TEST_CASE("a mistake in an OBJ is reported with file and line", "[unit][scene]") {
    const SceneFiles files;
    const auto error = [&](const std::string& text) { return error_from([&] { (void)load_obj(files.write("m.obj", text)); }); };
    CHECK_ERROR(error("v 0 0 0\nv 1 0 nan\n"), "m.obj:2", "vertex 1", "nan", "finite");
    CHECK_ERROR(error("v 0 0 1.5x\n"), "m.obj:1", "'1.5x' is not a number");
    CHECK_ERROR(error("v 0 0\n"), "m.obj:1", "2 numbers; expected 3");
    CHECK_ERROR(error("v 0 0 2e18\nv 0 0 0\nv 1 1 1\nf 1 2 3\n"), "m.obj", "vertex 0", "1e+18");
    CHECK_ERROR(error(kQuad + "f 1 2 5\n"), "m.obj:5", "'5'", "4 v before it");
    CHECK_ERROR(error(kQuad + "f 1 2 0\n"), "m.obj:5", "'0'");
    CHECK_ERROR(error(kQuad + "f 1 2 3x\n"), "m.obj:5", "'3x' is not a corner");
    CHECK_ERROR(error(kQuad + "f 1/1 2 3\n"), "m.obj:5", "0 vt before it");
    CHECK_ERROR(error(kQuad + "f 1 2\n"), "m.obj:5", "2 corners");
    CHECK_ERROR(error(kQuad + "curv 1 2\n"), "m.obj:5", "'curv'", "supported: v, vt, vn, f");
    CHECK_ERROR(error(kQuad), "m.obj", "no triangle");
    CHECK_ERROR(error(kQuad + "vn 0 0 1\nf 1//1 2//1 3//1\nf 1 3 4\n"), "m.obj", "all or none");
    CHECK_ERROR(error(kQuad + "vn 0 0 0\nf 1//1 2//1 3//1\n"), "m.obj", "normal of vertex 0", "not zero");
}

TEST_CASE("mesh errors carry the place in the scene as well", "[unit][scene]") {
    const SceneFiles files;
    files.write("m.obj", "v 0 0 inf\n");
    CHECK_ERROR(files.error_of("\n" + mesh_shape("obj", "m.obj")), "scene.xml:3:19", "m.obj:1", "inf");
    CHECK_ERROR(files.error_of("<shape type=\"obj\"/>"), "scene.xml:2:1", "filename");
}

TEST_CASE("a mesh without normals gets Mitsuba's smooth ones unless face_normals", "[unit][scene]") {
    const SceneFiles files;
    files.write("q.obj", kQuad + "f 1 2 3 4\n");
    const auto scene = files.load(
        mesh_shape("obj", "q.obj") + mesh_shape("obj", "q.obj", "<boolean name=\"face_normals\" value=\"true\"/>") +
        mesh_shape("obj", "q.obj", "<transform name=\"to_world\"><rotate x=\"1\" angle=\"30\"/><scale value=\"2\"/></transform>") +
        mesh_shape("obj", "q.obj", "<transform name=\"to_world\"><scale x=\"-1\" z=\"3\"/></transform>"));
    const auto& smooth = mesh_of(scene, 0);  // values of Mitsuba 3.9.1
    REQUIRE(smooth.normals.size() == 4);
    CHECK(near(smooth.normals[0], {0.370482773f, -0.370482773f, 0.851754069f}));
    CHECK(near(smooth.normals[1], {0, 0, 1}));
    CHECK(near(smooth.normals[3], {0.577350259f, -0.577350259f, 0.577350259f}));
    CHECK(mesh_of(scene, 1).normals.empty());
    CHECK(&mesh_of(scene, 2) == &smooth);  // angles are kept, so the data is shared
    const auto& stretched = mesh_of(scene, 3);
    const glm::vec3 n = stretched.normals[0];
    const glm::vec3 world = glm::normalize(glm::vec3(-n.x, n.y, n.z / 3.0f));  // inverse transpose
    CHECK(near(world, {0.542631388f, 0.542631388f, -0.641172588f}));           // Mitsuba 3.9.1
}

TEST_CASE("triangles without area are kept and have normals", "[unit][scene]") {
    const SceneFiles files;
    files.write("d.obj", "v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\n");
    const auto scene = files.load(mesh_shape("obj", "d.obj"));
    CHECK(mesh_of(scene).triangles.size() == 1);
    CHECK(mesh_of(scene).normals[0] == glm::vec3(1, 0, 0));
}

TEST_CASE("v of an OBJ is turned over, v of a PLY is not, unless asked for", "[unit][scene]") {
    const SceneFiles files;
    files.write("q.obj", kQuad + "vt .25 .25\nf 1/1 2/1 3/1\n");
    files.write("q.ply", binary_ply(false));
    const std::string yes = "<boolean name=\"flip_tex_coords\" value=\"true\"/>",
                      no = "<boolean name=\"flip_tex_coords\" value=\"false\"/>";
    const auto scene = files.load(mesh_shape("obj", "q.obj") + mesh_shape("obj", "q.obj", no) + mesh_shape("ply", "q.ply") +
                                  mesh_shape("ply", "q.ply", yes));
    CHECK(mesh_of(scene, 0).uvs[0] == glm::vec2(0.25f, 0.75f));
    CHECK(mesh_of(scene, 1).uvs[0] == glm::vec2(0.25f, 0.25f));
    CHECK(mesh_of(scene, 2).uvs[0] == glm::vec2(0.0f, 0.25f));
    CHECK(mesh_of(scene, 3).uvs[0] == glm::vec2(0.0f, 0.75f));
}

TEST_CASE("PLY files of both byte orders and in ascii say the same", "[unit][scene]") {
    const SceneFiles files;
    const auto little = load_ply(files.write("l.ply", binary_ply(false))), big = load_ply(files.write("b.ply", binary_ply(true)));
    REQUIRE(little.positions.size() == 4);
    CHECK(little.positions[3] == glm::vec3(0, 1, 0.5f));
    CHECK(little.normals[1] == glm::vec3(0, 0, 1));
    CHECK(little.uvs[1] == glm::vec2(1, 0.25f));
    REQUIRE(little.triangles.size() == 3);
    CHECK(little.triangles[1] == std::array<std::uint32_t, 3>{0, 2, 3});
    CHECK(little.triangles[2] == std::array<std::uint32_t, 3>{3, 2, 1});
    CHECK(big.positions == little.positions);
    CHECK(big.normals == little.normals);
    CHECK(big.uvs == little.uvs);
    CHECK(big.triangles == little.triangles);
    const auto ascii = load_ply(files.write("a.ply", ascii_ply("0 0 0\r\n1 0 0\n1 1 0 0 1 .5\n", "4 0 1 2 3\n3 3 2 1\n", 4, 2)));
    CHECK(ascii.positions == little.positions);
    CHECK(ascii.triangles == little.triangles);
    CHECK(ascii.normals.empty());
}

TEST_CASE("a mistake in a PLY is reported with what is wrong", "[unit][scene]") {
    const SceneFiles files;
    const auto error = [&](const std::string& bytes) { return error_from([&] { (void)load_ply(files.write("m.ply", bytes)); }); };
    const std::string three = "0 0 0\n1 0 0\n1 1 0\n";
    CHECK_ERROR(error("plx\n"), "m.ply:1", "not a PLY");
    CHECK_ERROR(error("ply\nformat ascii 2.0\n"), "m.ply:2", "binary_big_endian");
    CHECK_ERROR(error("ply\nformat ascii 1.0\nelement vertex 1\nproperty half x\nend_header\n"), "m.ply:4", "'half'", "float");
    CHECK_ERROR(error("ply\nformat ascii 1.0\n"), "m.ply:3", "end_header");
    CHECK_ERROR(error(ascii_ply(three, "3 0 1 7\n", 3, 1)), "m.ply", "face 0 uses vertex 7; there are 3");
    CHECK_ERROR(error(ascii_ply(three, "3 0 1 -1\n", 3, 1)), "face 0 uses vertex -1");
    CHECK_ERROR(error(ascii_ply(three, "2 0 1\n", 3, 1)), "face 0 has 2 corners");
    CHECK_ERROR(error(ascii_ply(three, "3 0 1 x\n", 3, 1)), "m.ply:13", "'x' is not an integer");
    CHECK_ERROR(error(ascii_ply(three, "3 0 1 2\n9\n", 3, 1)), "m.ply:14", "more than the data");
    CHECK_ERROR(error(ascii_ply(three, "3 0 1\n", 3, 1)), "ends before its data");
    CHECK_ERROR(error(ascii_ply("0 0 nan\n1 0 0\n1 1 0\n", "3 0 1 2\n", 3, 1)), "m.ply", "vertex 0", "finite");
    CHECK_ERROR(error(ascii_ply(three, "", 3, 0)), "no triangle");
    CHECK_ERROR(error(ascii_ply(three, "", 2000000000, 1)), "too short");
    const std::string whole = binary_ply(false);
    CHECK_ERROR(error(whole.substr(0, whole.size() - 1)), "ends before its data");
    CHECK_ERROR(error(whole + "xy"), "2 bytes follow");
}

TEST_CASE("8-bit images follow the sRGB curve unless they are raw", "[unit][scene]") {
    const SceneFiles files;
    const auto file = files.write("t.png", kPngBytes);
    const auto image = load_image(file, false), raw = load_image(file, true);
    REQUIRE(image.texels.size() == 4);
    CHECK(image.texels[0] == Rgb(1, 0, 0));
    CHECK(image.texels[1] == Rgb(0, 1, 0));
    CHECK(image.texels[2] == Rgb(0, 0, 1));
    CHECK(std::abs(image.texels[3].r - 0.2158605f) < 1e-6f);
    CHECK(raw.texels[3] == Rgb(128.0f / 255.0f));
}

TEST_CASE("EXR images have R, G, B or Y", "[unit][scene]") {
    const SceneFiles files;
    const auto file = files.directory() / "e.exr";
    write_exr(file, {{1, 2}, {3, 4}, {5, 6}, {9, 9}}, {"R", "G", "B", "A"}, 2, 1);
    const auto image = load_image(file, false);
    CHECK(image.width == 2);
    CHECK(image.texels[1] == Rgb(2, 4, 6));
    write_exr(file, {{0.5f, 2}}, {"Y"}, 1, 2);
    CHECK(load_image(file, false).texels[1] == Rgb(2.0f));
    write_exr(file, {{0.5f, 2}}, {"depth"}, 1, 2);
    CHECK_ERROR(error_from([&] { (void)load_image(file, false); }), "e.exr", "R, G, B", "depth");
    write_exr(file, {{0.5f, -2}}, {"Y"}, 2, 1);
    CHECK_ERROR(error_from([&] { (void)load_image(file, false); }), "e.exr", "texel (1, 0)", "not negative");
    write_exr(file, {{std::nanf(""), 2}}, {"Y"}, 1, 2);
    CHECK_ERROR(error_from([&] { (void)load_image(file, false); }), "texel (0, 0)", "finite");
}

TEST_CASE("files that are not images are refused", "[unit][scene]") {
    const SceneFiles files;
    CHECK_ERROR(error_from([&] { (void)load_image(files.write("x.png", "hello"), false); }), "x.png", "PNG, JPEG, Radiance HDR, OpenEXR");
    CHECK_ERROR(error_from([&] { (void)load_image(files.write("x.png", kPngBytes.substr(0, 30)), false); }), "x.png", "cannot be decoded");
    CHECK_ERROR(error_from([&] { (void)load_image(files.write("x.exr", "\x76\x2f\x31\x01zzzz"), false); }), "x.exr", "cannot be decoded");
}

TEST_CASE("pictures that claim more than they hold are refused before memory is asked for", "[unit][scene]") {
    const SceneFiles files;
    std::string png = kPngBytes;
    REQUIRE(png.substr(37, 4) == "IDAT");
    png[33] = '\x44';
    CHECK_ERROR(error_from([&] { (void)load_image(files.write("x.png", png), false); }), "x.png", "PNG chunk at byte 33", "the file ends after");
    png = kPngBytes;
    png[18] = png[22] = '\x10';  // 4098 pixels wide, as many high
    CHECK_ERROR(error_from([&] { (void)load_image(files.write("x.png", png), false); }), "x.png", "cannot hold the 4098 x 4098 pixels");
    const std::string table = "\xff\xd8\xff\xc4\x01\x20" + std::string(3, '\0') + std::string(14, '\x14') + std::string(300, '\0');
    CHECK_ERROR(error_from([&] { (void)load_image(files.write("x.jpg", table), false); }), "x.jpg", "Huffman table at byte 6 has 280 codes", "at most 256");
    CHECK_ERROR(error_from([&] { (void)load_image(files.write("x.hdr", "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 20000 +X 20000\n"), false); }), "x.hdr",
                "cannot hold the 20000 x 20000 pixels");
}

TEST_CASE("textures take filter, wrapping, transform and check their range", "[unit][scene]") {
    const SceneFiles files;
    files.write("t.png", kPngBytes);
    write_exr(files.directory() / "bright.exr", {{0.5f, 2}}, {"Y"}, 2, 1);
    const auto bsdf = [](const std::string& texture) {
        return "<shape type=\"cube\"><bsdf type=\"diffuse\">" + texture + "</bsdf></shape>";
    };
    const auto scene = files.load(bsdf(R"(<texture type="bitmap" name="reflectance"><string name="filename" value="t.png"/>
        <string name="filter_type" value="nearest"/><string name="wrap_mode" value="mirror"/>
        <transform name="to_uv"><scale x="2" y="3"/><translate x=".5"/></transform></texture>)"));
    const auto& t = std::get<BitmapTexture>(std::get<Diffuse>(scene.materials.at(1).front).reflectance);
    CHECK(t.filter == BitmapTexture::Filter::nearest);
    CHECK(t.wrap == BitmapTexture::Wrap::mirror);
    CHECK(t.to_uv * glm::dvec3(1, 1, 1) == glm::dvec3(2.5, 3, 1));
    CHECK(t.image->width == 2);
    CHECK_ERROR(files.error_of(bsdf(R"(<texture type="bitmap" name="reflectance"><string name="filename" value="bright.exr"/></texture>)")),
                "scene.xml:2:", "texel (1, 0) of bright.exr", "[0, 1]");
    CHECK_ERROR(files.error_of(bsdf(R"(<texture type="bitmap" name="reflectance"><string name="filename" value="no.png"/></texture>)")),
                "no.png", "tried");
    CHECK_ERROR(
        files.error_of(bsdf(
            R"(<texture type="bitmap" name="reflectance"><string name="filename" value="t.png"/><string name="wrap_mode" value="once"/></texture>)")),
        "repeat, mirror, clamp");
    CHECK_ERROR(files.error_of(bsdf(R"(<texture type="checkerboard" name="reflectance"><float name="color0" value="2"/></texture>)")),
                "'color0'", "[0, 1]");
    CHECK_ERROR(files.error_of(bsdf(R"(<texture type="checkerboard"/>)")), "takes no texture here");
    CHECK(
        files.error_of(
            R"(<shape type="cube"><emitter type="area"><texture type="bitmap" name="radiance"><string name="filename" value="bright.exr"/></texture></emitter></shape>)") ==
        "no error");
}

TEST_CASE("an environment map keeps its image, scale and transform", "[unit][scene]") {
    const SceneFiles files;
    write_exr(files.directory() / "sky.exr", {{0.5f, 2}}, {"Y"}, 2, 1);
    const auto scene = files.load(R"(<emitter type="envmap"><string name="filename" value="sky.exr"/><float name="scale" value="3"/>
        <transform name="to_world"><rotate x="1" angle="90"/></transform></emitter>)");
    const auto& map = std::get<MapEnvironment>(scene.environment.value());
    CHECK(map.scale == 3.0f);
    CHECK(map.image->texels[1] == Rgb(2.0f));
    CHECK(map.to_world[1][2] == 1.0);
    CHECK_ERROR(
        files.error_of(R"(<emitter type="envmap"><string name="filename" value="sky.exr"/><float name="scale" value="-1"/></emitter>)"),
        "negative");
    CHECK_ERROR(files.error_of("<emitter type=\"envmap\"/>"), "filename");
    CHECK_ERROR(
        files.error_of(R"(<emitter type="envmap"><string name="filename" value="sky.exr"/><float name="scale" value="3e38"/></emitter>)"),
        "infinite");
}

TEST_CASE("the hash follows the contents of meshes and images", "[unit][scene]") {
    const SceneFiles files;
    const auto hash = [&](const std::string& last) {
        files.write("m.obj", "v 0 0 0\nv 1 0 0\nv 0 1 " + last + "\nf 1 2 3\n");
        return files.load(mesh_shape("obj", "m.obj")).hash;
    };
    const auto base = hash("0");
    CHECK(hash("0.0") == base);
    CHECK(hash("-0") == base);
    CHECK(hash("1e-30") != base);
}

namespace {

/// One mesh as Mitsuba writes it: flags (1 normals, 2 texture coordinates, 8 colours), a triangle.
template <class Real>
std::string serialized_mesh(std::uint32_t flags, std::uint16_t version, float offset) {
    std::string data;
    const auto put = [&](const auto& value) { data.append(reinterpret_cast<const char*>(&value), sizeof value); };
    put(flags | (sizeof(Real) == 8 ? 0x2000u : 0x1000u));
    if (version == 4) data += std::string("name") + '\0';
    put(std::uint64_t{3}), put(std::uint64_t{1});
    for (const float v : {0.f, 0.f, offset, 1.f, 0.f, offset, 0.f, 1.f, offset}) put(static_cast<Real>(v));
    if (flags & 1) for (int i = 0; i < 3; ++i) for (const Real v : {Real(0), Real(0), Real(1)}) put(v);
    if (flags & 2) for (const Real v : {Real(0), Real(.25), Real(1), Real(.5), Real(.75), Real(1)}) put(v);
    if (flags & 8) for (int i = 0; i < 9; ++i) put(static_cast<Real>(0.125 * i));
    for (const std::uint32_t i : {0u, 1u, 2u}) put(i);
    std::string packed(compressBound(static_cast<uLong>(data.size())), '\0');
    uLongf size = static_cast<uLongf>(packed.size());
    compress(reinterpret_cast<Bytef*>(packed.data()), &size, reinterpret_cast<const Bytef*>(data.data()), static_cast<uLong>(data.size()));
    packed.resize(size);
    std::string header;
    for (const std::uint16_t v : {std::uint16_t{0x041C}, version}) header.append(reinterpret_cast<const char*>(&v), 2);
    return header + packed;
}

std::string serialized_file(const std::vector<std::string>& meshes, std::uint16_t version) {
    std::string file, table;
    for (const std::string& m : meshes) {
        const std::uint64_t at = file.size();
        table.append(reinterpret_cast<const char*>(&at), version == 4 ? 8 : 4);
        file += m;
    }
    const auto count = static_cast<std::uint32_t>(meshes.size());
    return file + table + std::string(reinterpret_cast<const char*>(&count), 4);
}

}  // namespace

TEST_CASE("serialized meshes of both versions and precisions are read by index", "[unit][scene]") {
    const SceneFiles files;
    for (const std::uint16_t version : {std::uint16_t{3}, std::uint16_t{4}}) {
        const auto file = files.write("m.serialized", serialized_file({serialized_mesh<float>(0, version, 5), serialized_mesh<double>(0xB, version, 7)}, version));
        const MeshData plain = load_serialized(file), full = load_serialized(file, 1);
        CHECK(plain.positions == std::vector<glm::vec3>{{0, 0, 5}, {1, 0, 5}, {0, 1, 5}});
        CHECK(plain.normals.empty());
        CHECK(full.positions[2] == glm::vec3(0, 1, 7));
        CHECK(full.normals[1] == glm::vec3(0, 0, 1));
        CHECK(full.uvs[1] == glm::vec2(1, .5f));
        CHECK(full.attributes.at(0).name == "vertex_color");
        CHECK(full.attributes[0].values[1] == Rgb(.375f, .5f, .625f));
        CHECK(full.triangles == std::vector<std::array<std::uint32_t, 3>>{{0, 1, 2}});
        CHECK(has(error_from([&] { (void)load_serialized(file, 2); }), {"no mesh 2", "has 2"}));
    }
    const auto scene = files.load(R"(<shape type="serialized"><string name="filename" value="m.serialized"/><integer name="shape_index" value="1"/></shape>)");
    CHECK(std::get<MeshShape>(scene.shapes.at(0).geometry).data->positions[0].z == 7.0f);
}

TEST_CASE("a damaged serialized mesh is refused", "[unit][scene]") {
    const SceneFiles files;
    const auto error = [&](const std::string& bytes, std::uint32_t index = 0) {
        return error_from([&] { (void)load_serialized(files.write("m.serialized", bytes), index); });
    };
    const std::string whole = serialized_file({serialized_mesh<float>(0, 4, 5)}, 4);
    CHECK(has(error("abcdefgh"), {"m.serialized", "not a serialized mesh"}));
    CHECK(has(error(""), {"ends before"}));
    CHECK(has(error(whole.substr(0, 30)), {"damaged"}));
    std::string other = whole;
    other[2] = 9;
    CHECK(has(error(other), {"version 9", "3, 4"}));
    other = whole;
    other[4] = 0;  // of zlib's own header
    CHECK(has(error(other), {"damaged"}));
    CHECK(has(error(whole, 7), {"no mesh 7"}));
}

TEST_CASE("attributes of PLY meshes have Mitsuba's names", "[unit][scene]") {
    const SceneFiles files;
    const auto attributes = [&](const std::string& vertex, const std::string& face, const std::string& values, const std::string& face_values) {
        std::string text = "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n";
        const auto properties = [&](const std::string& names) {
            std::istringstream words(names);
            for (std::string w; words >> w;) text += "property float " + w + "\n";
        };
        properties(vertex);
        text += "element face 1\nproperty list uchar int vertex_indices\n";
        properties(face);
        text += "end_header\n";
        for (const char* p : {"0 0 0 ", "1 0 0 ", "0 1 0 "}) text += p + values + "\n";
        return load_ply(files.write("a.ply", text + "3 0 1 2 " + face_values + "\n")).attributes;
    };
    const auto color = attributes("color_0 color_1 color_2", "weight_0", "1 2 3", "4");
    REQUIRE(color.size() == 2);
    CHECK(color[0].name == "vertex_color");
    CHECK(color[0].values[2] == Rgb(1, 2, 3));
    CHECK(color[1].name == "face_weight");
    CHECK(color[1].values == std::vector<Rgb>{Rgb(4.0f)});  // one number is a grey
    CHECK(attributes("r g b", "", "1 2 3", "").at(0).name == "vertex_color");
    CHECK(attributes("a_x a_y a_z", "", "1 2 3", "").at(0).name == "vertex_a");
    CHECK(attributes("c_r c_g c_b", "", "1 2 3", "").at(0).name == "vertex_c_color");
    CHECK(attributes("a_0 a_1", "", "1 2", "").empty());
    CHECK(attributes("foo", "", "1", "").empty());
    // A material that looks up what its mesh does not have is refused when the scene is compiled.
    const auto scene = files.load(R"(<shape type="ply"><string name="filename" value="a.ply"/><bsdf type="diffuse">
        <texture name="reflectance" type="mesh_attribute"><string name="name" value="vertex_color"/></texture></bsdf></shape>)");
    CHECK(has(error_from([&] { (void)compile(scene); }), {"scene.xml:2", "'vertex_color'"}));
}
