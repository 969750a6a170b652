// Weights of reconstruction filters.

#include <scene/scene_files.h>
#include <scenes/render_scene.h>

using namespace koksma;
using namespace koksma::testing;

namespace {

std::string scene_with_filter(const std::string& type, int width, int height) {
    return "<scene version=\"3.0.0\"><sensor type=\"perspective\"><film type=\"hdrfilm\"><integer name=\"width\" value=\"" +
           std::to_string(width) + "\"/><integer name=\"height\" value=\"" + std::to_string(height) + "\"/><rfilter type=\"" + type +
           "\"/></film></sensor><emitter type=\"constant\"/></scene>";
}

}  // namespace

TEST_CASE("E12: every sample has weight one under every filter, so no sum of weights is zero", "[hard][render]") {
    const SceneFiles files;
    for (const char* type : {"box", "tent", "gaussian"})
        for (const auto& [w, h] : {std::pair{1, 1}, {1, 7}, {7, 1}, {3, 5}})
            for (const std::uint64_t spp : {1u, 3u}) {
                const Film film = Ready(files.load_text(scene_with_filter(type, w, h))).render("random", spp, 1).film;
                for (std::int32_t y = 0; y < h; ++y)
                    for (std::int32_t x = 0; x < w; ++x) {
                        INFO(type << " " << w << "x" << h << " pixel " << x << "," << y);
                        CHECK(film.count({x, y}) == spp);
                        CHECK(film.mean({x, y}).y == 1.0);
                    }
            }
}

TEST_CASE("E12: filters with negative lobes are refused by name", "[hard]") {
    const SceneFiles files;
    for (const char* type : {"mitchell", "lanczos", "catmullrom"}) {
        const std::string error = files.error_of_text(scene_with_filter(type, 4, 4));
        INFO(error);
        CHECK(error.find(type) != std::string::npos);
        CHECK(error.find("scene.xml:1:") != std::string::npos);
    }
}
