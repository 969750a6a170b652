#include "film_draw.h"
#include "refusal.h"

#include <samplers/npy.h>
#include <samplers/points.h>

#include <koksma_catch.h>

#include <bit>
#include <cstdio>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <limits>
#include <set>
#include <string>

using namespace koksma;
using namespace koksma::test;

namespace {

/// An .npy file by the specification, of values v(0), v(1), ..
template <class T>
std::string npy(int version, const std::string& shape, std::size_t count, double (*v)(std::size_t), const std::string& descr = sizeof(T) == 4 ? "<f4" : "<f8",
                const std::string& order = "False") {
    std::string header = "{'descr': '" + descr + "', 'fortran_order': " + order + ", 'shape': " + shape + ", }";
    const std::size_t start = version == 1 ? 10 : 12;
    header.resize((start + header.size() + 1 + 63) / 64 * 64 - start, ' ');
    header.back() = '\n';
    std::string bytes = "\x93NUMPY" + std::string(1, static_cast<char>(version)) + std::string(1, '\0');
    for (std::size_t k = 0; k < start - 8; ++k) bytes += static_cast<char>(header.size() >> (8 * k));
    bytes += header;
    for (std::size_t i = 0; i < count; ++i) {
        const std::uint64_t word = sizeof(T) == 4 ? std::bit_cast<std::uint32_t>(static_cast<float>(v(i))) : std::bit_cast<std::uint64_t>(v(i));
        for (std::size_t k = 0; k < sizeof(T); ++k) bytes += static_cast<char>(word >> (8 * k));
    }
    return bytes;
}

double value(std::size_t i) { return static_cast<double>(i * 37 % 256) / 256; }

class File {
public:
    File(const std::string& name, const std::string& bytes) : path((std::filesystem::temp_directory_path() / ("koksma_test_" + std::to_string(::getpid()) + "_" + name)).string()) {
        std::ofstream(path, std::ios::binary) << bytes;
    }
    ~File() { std::remove(path.c_str()); }
    File(const File&) = delete;
    File& operator=(const File&) = delete;
    const std::string path;
};

std::string refused(const std::string& bytes, const std::string& name = "p") {
    return refusal([&] { (void)PointSets::parse(bytes, name); });
}

std::string bound(const std::string& spec, std::uint64_t spp, std::uint64_t seed = 0, std::uint32_t pairs = 2) {
    return refusal([&] {
        Registry registry;
        registry.add<PointsSampler>();
        (void)registry.make("points:" + spec)->bind({.spp = spp, .seed = seed, .layout = film_layout(pairs, false)});
    });
}

}  // namespace

TEST_CASE("points: .npy of all versions and both types is read as it is", "[unit][samplers]") {
    for (const int version : {1, 2, 3})
        for (const std::string& bytes : {npy<float>(version, "(8, 2)", 16, value), npy<double>(version, "(8, 2)", 16, value)}) {
            const PointSets sets = PointSets::parse(bytes, "p");
            REQUIRE((sets.sets == 1 && sets.points == 8 && sets.dimensions == 2 && !sets.is_tile()));
            for (std::size_t i = 0; i < 16; ++i) REQUIRE(sets.values[i] == static_cast<std::uint32_t>(value(i) * 0x1p32));
        }
    const PointSets sets = PointSets::parse(npy<float>(1, "(3, 4, 2)", 24, value), "p");
    REQUIRE((sets.sets == 3 && sets.points == 4 && sets.dimensions == 2 && !sets.is_tile()));
    const PointSets tile = PointSets::parse(npy<float>(1, "(2, 3, 4, 5)", 120, value), "p");
    REQUIRE((tile.tile_height == 2 && tile.tile_width == 3 && tile.points == 4 && tile.dimensions == 5));
    const PointSets text = PointSets::parse("# two sets\n0.5 0.25\n.125, 0\n\n0.75\t0\n0 0.5 # last\n", "p");
    REQUIRE((text.sets == 2 && text.points == 2 && text.dimensions == 2));
    REQUIRE(text.values[2] == 0x20000000u);
}

TEST_CASE("points: bad .npy is refused with the reason", "[unit][samplers]") {
    const auto f4 = [](const std::string& shape, std::size_t n, const std::string& descr = "<f4", const std::string& order = "False", int version = 1) {
        return npy<float>(version, shape, n, value, descr, order);
    };
    REQUIRE(refused(f4("(4, 2)", 8)) == "accepted");
    REQUIRE(contains(refused(f4("(4, 2)", 8, ">f4")), "type '>f4'; '<f4' and '<f8'"));
    REQUIRE(contains(refused(f4("(4, 2)", 8, "<i4")), "type '<i4'"));
    REQUIRE(contains(refused(f4("(4, 2)", 8, "<f4", "True")), "Fortran order"));
    REQUIRE(contains(refused(f4("(4, 2)", 8, "<f4", "False", 4)), ".npy version 4"));
    REQUIRE(contains(refused(f4("(4, 2)", 7)), "has 28 bytes of data; the shape (4, 2) needs 32"));
    REQUIRE(contains(refused(f4("(4, 2)", 9)), "has 36 bytes of data"));
    REQUIRE(contains(refused(f4("(8,)", 8)), "has 1 dimension(s)"));
    REQUIRE(contains(refused(f4("(0, 2)", 0)), "is empty: its shape is (0, 2)"));
    REQUIRE(contains(refused(f4("(4294967296, 4294967296)", 8)), "ends too early"));
    REQUIRE(contains(refused(f4("4, 2", 8)), "header that is not understood"));
    REQUIRE(contains(refused(f4("(4, 2)", 8).substr(0, 30)), "ends within its header"));
    REQUIRE(contains(refused("0.5 0.5\n", "p.npy"), "is not an .npy file"));
    REQUIRE(contains(refused(npy<double>(1, "(2, 1)", 2, [](std::size_t i) { return i == 1 ? 1.0 : 0.5; })), "p, number 1: the coordinate 1.000000 is not in [0, 1)"));
    REQUIRE(contains(refused(npy<double>(1, "(1, 1)", 1, [](std::size_t) { return std::numeric_limits<double>::quiet_NaN(); })), "not in [0, 1)"));
    // Cut anywhere, it is refused and nothing else happens.
    const std::string whole = f4("(4, 2)", 8);
    for (std::size_t n = 6; n < whole.size(); ++n) REQUIRE(refused(whole.substr(0, n)) != "accepted");
}

TEST_CASE("points: bad text is refused with its line", "[unit][samplers]") {
    REQUIRE(contains(refused("0.5 0.5\n0.5\n"), "p:2: has 1 coordinates; the points before it have 2"));
    REQUIRE(contains(refused("0.5 0.5\n0.5 -0.1\n"), "p:2: the coordinate -0.1"));
    REQUIRE(contains(refused("0.5 0.5\n0.5 half\n"), "p:2: 'half' is not a number"));
    REQUIRE(contains(refused("0.5\n0.25\n\n0.5\n\n0.1\n"), "p:5: set 1 ends here with 1 points; those before it have 2"));
    REQUIRE(contains(refused("# nothing\n"), "has no points"));
}

TEST_CASE("points: without randomisation values are those of the file", "[unit][samplers]") {
    const File file("points.npy", npy<float>(1, "(16, 4)", 64, value));
    const Points p = draw_film<PointsSampler>("points:randomize=none,pad=all,file=" + file.path, {.width = 2, .height = 1, .spp = 16, .seed = 99});
    for (std::size_t pixel = 0; pixel < 2; ++pixel)
        for (std::size_t i = 0; i < 16; ++i)
            for (std::size_t d = 0; d < 4; ++d) REQUIRE(p(d, pixel * 16 + i) == static_cast<float>(value(4 * i + d)));
    // Further sets have the same points in another order.
    const Points q = draw_film<PointsSampler>("points:randomize=none,pad=4,file=" + file.path, {.width = 1, .height = 1, .spp = 16, .pairs = 6});
    for (std::size_t set = 0; set < 3; ++set) {
        std::multiset<float> first, other;
        int same_place = 0;
        for (std::size_t i = 0; i < 16; ++i) {
            first.insert(q(0, i));
            other.insert(q(4 * set, i));
            same_place += q(0, i) == q(4 * set, i);
        }
        REQUIRE(first == other);
        REQUIRE((set == 0 || same_place < 12));
    }
}

TEST_CASE("points: cp shifts a set as a whole, modulo 1", "[unit][samplers]") {
    const File file("shift.npy", npy<double>(2, "(16, 2)", 32, value));
    const Points p = draw_film<PointsSampler>("points:file=" + file.path, {.width = 3, .height = 1, .spp = 16, .seed = 7, .pairs = 1});
    for (std::size_t pixel = 0; pixel < 3; ++pixel)
        for (std::size_t d = 0; d < 2; ++d)
            for (std::size_t i = 0; i < 16; ++i) {
                const std::uint64_t moved = (p.bits24(d, pixel * 16 + i) - p.bits24(d, pixel * 16)) & 0xffffffu;
                REQUIRE(moved == (static_cast<std::uint64_t>((value(2 * i + d) - value(d)) * 0x1p24 + 0x1p24) & 0xffffffu));
            }
    REQUIRE(p(0, 0) != p(0, 16));
}

TEST_CASE("points: of K sets the seed takes its own, and more seeds than sets are refused without a randomisation", "[unit][samplers]") {
    const auto square = [](std::size_t i) { return static_cast<double>(i * i * 37 % 256) / 256; };  // no set is another one shifted
    const File file("sets.npy", npy<float>(1, "(3, 4, 2)", 24, square));
    const std::string name = "file=" + file.path;
    for (std::uint64_t seed = 0; seed < 3; ++seed) {
        const Points p = draw_film<PointsSampler>("points:randomize=none," + name, {.width = 1, .height = 1, .spp = 4, .seed = seed, .pairs = 1});
        for (std::size_t i = 0; i < 4; ++i) REQUIRE(p(1, i) == static_cast<float>(square((seed * 4 + i) * 2 + 1)));
    }
    REQUIRE(contains(bound("randomize=none," + name, 4, 3), "has 3 point set(s), numbered from 0, and no randomisation: seed 3 is beyond them"));
    REQUIRE(bound("randomize=cp," + name, 4, 3) == "accepted");
    REQUIRE(bound("randomize=none,set=1," + name, 4, 3) == "accepted");
    REQUIRE(contains(bound("set=3," + name, 4), "set=3 is not one of them"));
    REQUIRE(contains(bound("set=x," + name, 4), "set=x is not one of them"));
    // With shifts, pixels take all of the sets.
    std::set<std::uint64_t> seen;
    const Points p = draw_film<PointsSampler>("points:" + name, {.width = 16, .height = 1, .spp = 4, .pairs = 1});
    for (std::size_t pixel = 0; pixel < 16; ++pixel) seen.insert((p.bits24(0, 4 * pixel + 1) - p.bits24(0, 4 * pixel)) & 0xffffffu);
    REQUIRE(seen.size() == 3);
}

TEST_CASE("points: a screen tile gives each pixel its set, and one shift to all", "[unit][samplers]") {
    const File file("tile.npy", npy<float>(1, "(2, 3, 4, 2)", 48, value));
    const Points p = draw_film<PointsSampler>("points:randomize=none,file=" + file.path, {.width = 7, .height = 5, .spp = 4, .seed = 12, .pairs = 1});
    for (std::size_t y = 0; y < 5; ++y)
        for (std::size_t x = 0; x < 7; ++x)
            for (std::size_t i = 0; i < 4; ++i) REQUIRE(p(0, (y * 7 + x) * 4 + i) == static_cast<float>(value((((y % 2) * 3 + x % 3) * 4 + i) * 2)));
    const Points q = draw_film<PointsSampler>("points:file=" + file.path, {.width = 7, .height = 5, .spp = 4, .seed = 12, .pairs = 1});
    const std::uint64_t shift = (q.bits24(0, 0) - p.bits24(0, 0)) & 0xffffffu;
    for (std::size_t k = 0; k < q.count; ++k) REQUIRE(((q.bits24(0, k) - p.bits24(0, k)) & 0xffffffu) == shift);
    REQUIRE(contains(bound("set=1,file=" + file.path, 4), "the file is a tile"));
}

TEST_CASE("points: more samples or dimensions than the file has are refused", "[unit][samplers]") {
    const File file("few.txt", "0.5 0.5 0.5\n0.25 0.75 0.1\n");
    REQUIRE(bound("file=" + file.path, 2) == "accepted");
    REQUIRE(contains(bound("file=" + file.path, 3), "has 2 samples per pixel at most; 3"));
    REQUIRE(contains(bound("pad=none,file=" + file.path, 2), "has 3 dimensions; the plan has 4"));
    REQUIRE(contains(bound("pad=4,file=" + file.path, 2), "pad=4 needs 4"));
    REQUIRE(bound("pad=none,file=" + file.path, 2, 0, 1) == "accepted");
    REQUIRE(contains(bound("file=none/such.npy", 2), "none/such.npy: cannot be opened"));
    REQUIRE(contains(bound("", 4097), "has 4096 samples per pixel at most"));
    const File line("line.txt", "0.5\n0.25\n");
    REQUIRE(contains(bound("file=" + line.path, 2), "has 1 dimension; pad=2 needs 2"));
    REQUIRE(bound("pad=all,file=" + line.path, 2) == "accepted");
}
