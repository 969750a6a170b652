// One render, one result, with the batch kernel too: films that do not fill its packets, counts that do not fill its
// batches, any number of threads.

#include "traced.h"

using namespace koksma;
using namespace koksma::testing;

namespace {

struct Work {
    PixelRect rect;
    std::uint64_t first, count;
};

/// Odd films, crops at odd places, counts below, at and above a chunk, first samples inside one.
std::vector<Work> odd_work() {
    std::vector<Work> out;
    for (const PixelRect& rect : {PixelRect{0, 0, 45, 45}, PixelRect{0, 0, 1, 1}, PixelRect{7, 3, 13, 29}, PixelRect{44, 0, 1, 45}})
        for (const std::uint64_t count : {1, 3, 64, 100})
            for (const std::uint64_t first : {0, 37, 64}) out.push_back({rect, first, count});
    return out;
}

RenderOptions options(int threads, const Kernel& kernel) {
    RenderOptions o;
    o.threads = threads;
    o.kernel = &kernel;
    return o;
}

}  // namespace

TEST_CASE("both kernels give the same bytes for 1, 2 and 4 threads, whatever the film and the samples", "[kernels]") {
    for (const char* file : {"scenes/cornell.xml", "scenes/caustic.xml", "scenes/bokeh.xml"}) {
        const Ready ready(load_scene(std::filesystem::path(KOKSMA_SOURCE_DIR) / file, {{"res", "45"}}));
        for (const bool batch : {true, false}) {
            const Kernel& kernel = *family(ready.plan.effects, batch).front();
            for (const Work& w : odd_work()) {
                if (!batch && w.rect.area() > 1000) continue;  // the reference kernel's blocks end with the pixel
                const auto film = [&](int threads) { return ready.render(kSobol, 256, 3, {w.rect, w.first, w.count}, options(threads, kernel)).film; };
                const Film one = film(1);
                INFO(file << " " << kernel.name << " rect " << w.rect.x << "," << w.rect.y << " " << w.rect.width << "x" << w.rect.height << " samples " << w.first
                          << "+" << w.count);
                CHECK(one.count({w.rect.x, w.rect.y}) == w.count);
                CHECK(same_bytes(one, film(2)));
                CHECK(same_bytes(one, film(4)));
            }
        }
    }
}

// What else is in a packet is no business of a path.
TEST_CASE("a path does not depend on the others of its batch", "[kernels]") {
    std::uint64_t paths = 0;
    for (const NamedScene& s : kernel_scenes()) {
        const Ready ready(s.description);
        if (family(ready.plan.effects, true).empty()) continue;
        const Kernel& kernel = *family(ready.plan.effects, true).front();
        const Traced whole = trace_all(ready, kernel, 8, 21);
        for (const std::size_t at_once : {1, 5, 16, 1000}) {
            const Agreement a = compare(whole, trace_all(ready, kernel, 8, 21, at_once));
            INFO(s.name << " by " << at_once);
            CHECK(a.met_something_else == 0);
            CHECK(a.same_way_other_radiance == 0);
            paths += a.paths;
        }
    }
    CHECK(paths > 1'000'000);
}
