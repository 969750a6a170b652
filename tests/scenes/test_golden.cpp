// The mean colours of the built-in scenes at a fixed sampler, seed and size. They change only with the meaning of a render.
//
// When they change on purpose: bump kEstimatorVersion (koksma/measure/reference.h), then
//     build/release/bin/test_scenes_render "golden means are written anew"

#include "render_scene.h"

#include <koksma/measure/reference.h>
#include <koksma/scene/load.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>

using namespace koksma;
using namespace koksma::testing;

namespace {

const std::filesystem::path kTable = std::filesystem::path(KOKSMA_SOURCE_DIR) / "tests/scenes/golden.tsv";
constexpr const char* kRes = "32";
constexpr std::uint64_t kSpp = 64, kSeed = 20;

Vec3d mean_of(const std::filesystem::path& file) { return Ready(load_scene(file, {{"res", kRes}})).render(kSobol, kSpp, kSeed).film.mean(); }

std::vector<std::filesystem::path> scenes() {
    std::vector<std::filesystem::path> files;
    for (const auto& entry : std::filesystem::directory_iterator(std::filesystem::path(KOKSMA_SOURCE_DIR) / "scenes"))
        if (entry.path().extension() == ".xml") files.push_back(entry.path());
    std::sort(files.begin(), files.end());
    return files;
}

}  // namespace

TEST_CASE("the built-in scenes have their golden means", "[scenes]") {
    std::ifstream in(kTable);
    REQUIRE(in);
    std::map<std::string, Vec3d> golden;
    int version = 0;
    for (std::string line; std::getline(in, line);) {
        if (line.empty() || line[0] == '#') continue;
        std::istringstream fields(line);
        std::string scene;
        Vec3d rgb;
        REQUIRE((fields >> scene >> version >> rgb.x >> rgb.y >> rgb.z));
        golden[scene] = rgb;
    }
    for (const auto& file : scenes()) {
        INFO(file << ": if this change is meant, bump kEstimatorVersion and remake the table (see test_golden.cpp)");
        const auto row = golden.find(file.stem().string());
        REQUIRE(row != golden.end());
        CHECK(version == kEstimatorVersion);
        const Vec3d got = mean_of(file), want = row->second;
        // Same bits are promised on one machine; another compiler's setup in double may move the last digits of float.
        for (const auto& [g, w] : {std::pair{got.x, want.x}, {got.y, want.y}, {got.z, want.z}}) CHECK(std::fabs(g - w) <= 1e-6 * w);
    }
}

TEST_CASE("golden means are written anew", "[.]") {
    std::FILE* out = std::fopen(kTable.string().c_str(), "w");
    REQUIRE(out != nullptr);
    std::fprintf(out, "# Mean linear RGB of the built-in scenes: res %s, %s, %d spp, seed %d.\n", kRes, kSobol, static_cast<int>(kSpp), static_cast<int>(kSeed));
    std::fprintf(out, "# Made by: build/release/bin/test_scenes_render \"golden means are written anew\"\n");
    std::fprintf(out, "# scene\testimator_version\tred\tgreen\tblue\n");
    for (const auto& file : scenes()) {
        const Vec3d m = mean_of(file);
        std::fprintf(out, "%s\t%d\t%.10g\t%.10g\t%.10g\n", file.stem().string().c_str(), kEstimatorVersion, m.x, m.y, m.z);
    }
    CHECK(std::fclose(out) == 0);
}
