// Mitsuba's own render tests: its scenes, its references, its budget of samples, its statistical test. Skips where they are not.

#include "render_scene.h"

#include <koksma/film/exr.h>
#include <koksma/sampling/error.h>
#include <koksma/scene/load.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <iostream>

using namespace koksma;
using namespace koksma::testing;

namespace {

/// Scenes are named NAME_INTEGRATOR.xml, their references refs/NAME_ref_rgb.exr and refs/NAME_ref_rgb_var.exr.
struct Peer {
    std::filesystem::path scene, reference, variance;
};

std::vector<Peer> peers() {
    std::vector<Peer> out;
    const char* folder = std::getenv("KOKSMA_PEER_SCENES");
    if (folder == nullptr || !std::filesystem::is_directory(folder)) return out;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
        if (entry.path().extension() != ".xml") continue;
        std::string stem = entry.path().stem().string();
        stem = stem.substr(0, stem.rfind('_'));
        const auto refs = entry.path().parent_path() / "refs";
        Peer p{entry.path(), refs / (stem + "_ref_rgb.exr"), refs / (stem + "_ref_rgb_var.exr")};
        if (std::filesystem::exists(p.reference) && std::filesystem::exists(p.variance)) out.push_back(std::move(p));
    }
    std::sort(out.begin(), out.end(), [](const Peer& a, const Peer& b) { return a.scene < b.scene; });
    return out;
}

struct Verdict {
    double passing = 0, bias = 0, relative = 0;
    bool good = false;
};

/// Mitsuba's test: z of each pixel in X, Y and Z under the reference's variance of a sample, two-sided at the level that Sidak's
/// correction gives 1 % over all pixels; 99.75 % must pass. And one of ours: the whole image must not be darker or brighter.
Verdict judge(const Film& film, const Peer& peer, double spp) {
    const std::vector<float> mean = read_exr(peer.reference).rgb(), variance = read_exr(peer.variance).rgb();
    const PixelRect r = film.rect();
    const auto pixels = static_cast<double>(r.area());
    const double alpha = 1.0 - std::pow(1.0 - 0.01, 1.0 / pixels);
    double good = 0, difference = 0, difference_variance = 0, sum = 0;
    std::size_t i = 0;
    for (std::int32_t y = r.y; y < r.y + r.height; ++y)
        for (std::int32_t x = r.x; x < r.x + r.width; ++x, i += 3) {
            const Vec3d own = xyz_of(film.mean({x, y})), reference = xyz_of({mean[i], mean[i + 1], mean[i + 2]});
            const Vec3d v = xyz_of({variance[i], variance[i + 1], variance[i + 2]});
            for (const auto& [a, b, s] : {std::tuple{own.x, reference.x, v.x}, {own.y, reference.y, v.y}, {own.z, reference.z, v.z}}) {
                const double z = std::fabs(a - b) * std::sqrt(spp / std::max(s, 1e-4));
                good += std::erfc(z / std::sqrt(2.0)) > alpha ? 1.0 : 0.0;
            }
            difference += own.y - reference.y;
            difference_variance += std::max(v.y, 0.0) * (1.0 / spp + 1.0 / 32000.0);
            sum += reference.y;
        }
    Verdict out;
    out.passing = good / (3.0 * pixels);
    out.bias = difference / std::sqrt(std::max(difference_variance, 1e-30));
    out.relative = difference / sum;
    out.good = out.passing >= 0.9975 && (std::fabs(out.bias) < 6.0 || std::fabs(out.relative) < 1e-3);
    return out;
}

}  // namespace

TEST_CASE("the peer's scenes look as the peer says", "[peer]") {
    const std::vector<Peer> all = peers();
    if (all.empty()) std::cout << "SKIPPED: KOKSMA_PEER_SCENES names no folder with scenes and references\n";
    for (const Peer& peer : all) {
        SceneDescription description;
        try {
            description = load_scene(peer.scene);
        } catch (const Error& e) {
            FAIL_CHECK("refused: " << peer.scene.filename().string() << ": " << e.what());
            continue;
        }
        const Ready ready(description);
        const PixelRect rect = crop_of(ready.scene.film);
        const auto spp = static_cast<std::uint64_t>(2000000 / rect.area());  // the peer's budget
        for (const char* sampler : {"random", kSobol}) {
            const RenderResult result = ready.render(sampler, spp, 1);
            const Verdict v = judge(result.film, peer, static_cast<double>(spp));
            std::cout << (v.good ? "passed   " : "FAILED   ") << peer.scene.filename().string() << ' ' << sampler << ", " << spp << " spp: " << 100 * v.passing
                      << " % of the values, whole image " << v.bias << " sigma, " << 100 * v.relative << " %\n";
            INFO(peer.scene << ' ' << sampler);
            CHECK(v.good);
            CHECK(result.stats.invalid_samples == 0);
        }
    }
}
