// One render, one result: for any number of threads, any split of the work, any crop.

#include "render_scene.h"

#include <koksma/scene/load.h>

#include <algorithm>
#include <filesystem>
#include <stop_token>

using namespace koksma;
using namespace koksma::testing;

namespace {

std::vector<std::filesystem::path> built_in_scenes() {
    std::vector<std::filesystem::path> files;
    for (const auto& entry : std::filesystem::directory_iterator(std::filesystem::path(KOKSMA_SOURCE_DIR) / "scenes"))
        if (entry.path().extension() == ".xml") files.push_back(entry.path());
    std::sort(files.begin(), files.end());
    return files;
}

RenderOptions threads(int n) {
    RenderOptions o;
    o.threads = n;
    return o;
}

}  // namespace

TEST_CASE("any number of threads and any run gives the same bytes", "[scenes]") {
    for (const auto& file : built_in_scenes()) {
        const Ready ready(load_scene(file, {{"res", "20"}}));
        const Film one = ready.render(kSobol, 70, 3, threads(1)).film;
        for (const int n : {1, 2, 4, 7}) {
            INFO(file << " with " << n << " threads");
            CHECK(same_bytes(one, ready.render(kSobol, 70, 3, threads(n)).film));
        }
    }
}

TEST_CASE("work split at one chunk a film merges to the same bytes", "[scenes]") {
    constexpr std::uint64_t kSpp = 3 * Film::kChunk + 17;
    for (const auto& file : built_in_scenes()) {
        const Ready ready(load_scene(file, {{"res", "12"}}));
        const PixelRect rect = crop_of(ready.scene.film);
        const Film whole = ready.render(kSobol, kSpp, 5, {rect, 0, kSpp}).film;
        Film merged = ready.render(kSobol, kSpp, 5, {rect, 0, Film::kChunk}).film;
        for (std::uint64_t first = Film::kChunk; first < kSpp; first += Film::kChunk)
            merged.merge(ready.render(kSobol, kSpp, 5, {rect, first, std::min(Film::kChunk, kSpp - first)}).film);
        INFO(file);
        CHECK(same_bytes(whole, merged));
    }
}

// Plain sums of doubles are not associative, a + b + c against a + (b + c): with them 37 of 100 differed.
TEST_CASE("any split at chunk boundaries merges to the same bytes, whatever the radiances", "[scenes]") {
    int differing = 0;
    for (int trial = 0; trial < 100; ++trial) {
        Film whole({0, 0, 1, 1}), first({0, 0, 1, 1}), later({0, 0, 1, 1});
        for (std::uint32_t c = 0; c < 8; ++c) {
            Vec3f chunk[Film::kChunk];
            for (std::uint32_t i = 0; i < Film::kChunk; ++i) {
                // Six decades of radiance, as in a scene with a lamp and its highlights.
                const float u = unit_float(keyed_hash({static_cast<std::uint32_t>(trial), 1}, c * 64 + i));
                chunk[i] = Vec3f(std::pow(10.0f, 12.0f * u - 6.0f));
            }
            whole.add({0, 0}, chunk);
            (c == 0 ? first : later).add({0, 0}, chunk);
        }
        first.merge(later);
        differing += !(first.mean({0, 0}) == whole.mean({0, 0}));
    }
    INFO(differing << " of 100 sums of 8 chunks differ when merged as 1 + 7");
    CHECK(differing == 0);
}

TEST_CASE("a crop holds the bytes of the full film", "[scenes]") {
    for (const auto& file : built_in_scenes()) {
        SceneDescription d = load_scene(file, {{"res", "32"}});
        const Film full = Ready(d).render(kSobol, 20, 9).film;
        d.film.crop_x = 11;
        d.film.crop_y = 5;
        d.film.crop_width = 13;
        d.film.crop_height = 9;
        const Film crop = Ready(d).render(kSobol, 20, 9).film;
        INFO(file);
        REQUIRE(crop.rect().width == 13);
        bool same = true;
        for (std::int32_t y = 5; y < 14; ++y)
            for (std::int32_t x = 11; x < 24; ++x) same = same && full.mean({x, y}) == crop.mean({x, y});
        CHECK(same);
    }
}

TEST_CASE("a prefix of a sequence is the same samples", "[scenes]") {
    const Ready ready(load_scene(std::filesystem::path(KOKSMA_SOURCE_DIR) / "scenes/cornell.xml", {{"res", "12"}}));
    const PixelRect rect = crop_of(ready.scene.film);
    CHECK(same_bytes(ready.render(kSobol, 64, 2, {rect, 0, 64}).film, ready.render(kSobol, 1024, 2, {rect, 0, 64}).film));
}

TEST_CASE("a seed has its image and another seed another", "[scenes]") {
    const Ready ready(load_scene(std::filesystem::path(KOKSMA_SOURCE_DIR) / "scenes/cornell.xml", {{"res", "12"}}));
    for (const char* sampler : {"random", "stratified", "halton", kSobol}) {
        INFO(sampler);
        const Film one = ready.render(sampler, 4, 1).film;
        CHECK(same_bytes(one, ready.render(sampler, 4, 1).film));
        CHECK_FALSE(same_bytes(one, ready.render(sampler, 4, 2).film));
    }
}

TEST_CASE("a stop token stops between tiles and says so", "[scenes]") {
    const Ready ready(load_scene(std::filesystem::path(KOKSMA_SOURCE_DIR) / "scenes/smooth.xml", {{"res", "64"}}));
    std::stop_source before;
    before.request_stop();
    RenderOptions o;
    o.stop = before.get_token();
    const RenderResult nothing = ready.render("random", 4, 1, o);
    CHECK(nothing.stats.stopped);
    CHECK(nothing.stats.paths == 0);
    CHECK(nothing.film.mean() == Vec3d{});

    std::stop_source during;
    o.stop = during.get_token();
    o.threads = 1;
    double last = 0;
    o.progress = [&](double done) {
        CHECK(done > last);
        last = done;
        if (done > 0.3) during.request_stop();
    };
    const RenderResult part = ready.render("random", 4, 1, o);
    CHECK(part.stats.stopped);
    CHECK(part.stats.paths > 0);
    CHECK(part.stats.paths < 64 * 64 * 4);
    const Film whole = ready.render("random", 4, 1).film;
    std::uint64_t samples = 0;
    bool same = true;
    for (std::int32_t y = 0; y < 64; ++y)
        for (std::int32_t x = 0; x < 64; ++x) {
            const std::uint64_t n = part.film.count({x, y});
            samples += n;
            same = same && (n == 0 || (n == 4 && part.film.mean({x, y}) == whole.mean({x, y})));
        }
    CHECK(same);
    CHECK(samples == part.stats.paths);
}

TEST_CASE("progress ends at 1 and a whole render is not stopped", "[scenes]") {
    const Ready ready(load_scene(std::filesystem::path(KOKSMA_SOURCE_DIR) / "scenes/smooth.xml", {{"res", "20"}}));
    double last = 0;
    RenderOptions o;
    o.progress = [&](double done) { last = done; };
    const RenderResult r = ready.render("random", 2, 1, o);
    CHECK(last == 1.0);
    CHECK_FALSE(r.stats.stopped);
    CHECK(r.stats.paths == 20 * 20 * 2);
}
