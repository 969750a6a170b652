// Conversions to float, films of odd shapes, long sums, discrete distributions.

#include <scenes/render_scene.h>

#include <koksma/film/film.h>
#include <koksma/scene/distribution.h>

using namespace koksma;
using namespace koksma::testing;

TEST_CASE("E1: no 32 bits become 1", "[hard]") {
    CHECK(unit_float(0xffffffffu) == kOneMinusUlp);
    CHECK(unit_float(0xffffff80u) < 1.0f);
    CHECK(unit_float(0xffffff7fu) < 1.0f);
}

TEST_CASE("E2: no fraction below 1 becomes 1", "[hard]") {
    CHECK(unit_float_ceil((1ull << 62) - 1, 1ull << 62) < 1.0f);
    CHECK(unit_float_ceil(3486784400ull, 3486784401ull) < 1.0f);
}

TEST_CASE("E4: a sample stays in its pixel", "[hard][render]") {
    SceneDescription d = empty_scene(16384, 1);
    d.camera.fov_x_degrees = 90;
    const Scene scene = compile(d);
    for (const std::int32_t px : {0, 1, 255, 1023, 4095, 16383}) {
        const auto low = camera_ray<float>(scene.camera, film_point(scene.camera, px, 0, {0.0f, 0.5f}), {0.0f, 0.0f});
        const auto high = camera_ray<float>(scene.camera, film_point(scene.camera, px, 0, {kOneMinusUlp, 0.5f}), {0.0f, 0.0f});
        const auto column = [](const auto& r) { return (1.0 - double{r.d.x} / r.d.z) * 0.5 * 16384; };
        INFO("pixel " << px << " from " << column(low) << " to " << column(high));
        // The direction is in float: 2^-23 of the half width of 8192 pixels.
        CHECK(column(low) >= px - 2e-3);
        CHECK(column(high) <= px + 1 + 2e-3);
        CHECK(column(high) > px + 0.99);
    }
    const Film film = Ready(d).render("random", 4, 1).film;
    CHECK(film.count({16383, 0}) == 4);
}

TEST_CASE("E9: films of one row or one column, one sample and a million", "[hard][render]") {
    for (const auto& [w, h] : {std::pair{1, 1}, {1, 7}, {7, 1}, {3, 5}, {17, 9}})
        for (const auto& [le, expected] : {std::pair{1.0f, 1.0}, {0.1f, double{0.1f}}}) {
            SceneDescription d = empty_scene(w, h);
            d.environment = ConstantEnvironment{Rgb(le), {}};
            const Film film = Ready(d).render(kSobol, 1, 1).film;
            CHECK(std::fabs(film.mean().y / expected - 1.0) < 1e-12);
        }
}

TEST_CASE("E10: a million samples of 0.1 have the mean 0.1", "[hard][render]") {
    SceneDescription d = empty_scene(1, 1);
    d.environment = ConstantEnvironment{Rgb(0.1f), {}};
    const Film film = Ready(d).render("random", 1 << 20, 1).film;
    CHECK(film.count({0, 0}) == 1 << 20);
    CHECK(std::fabs(film.mean().y / double{0.1f} - 1.0) < 1e-12);
}

TEST_CASE("E11: a film adds sixteen million uniform numbers without losing any", "[hard]") {
    Film film({0, 0, 1, 1});
    Vec3f chunk[Film::kChunk];
    double exact = 0;
    for (std::uint32_t c = 0; c < (1u << 18); ++c) {
        for (std::uint32_t i = 0; i < Film::kChunk; ++i) {
            const float u = unit_float(keyed_hash({1, 2}, c * 64 + i));
            chunk[i] = Vec3f(u);
            exact += u;
        }
        film.add({0, 0}, chunk);
    }
    CHECK(std::fabs(film.mean().x * 0x1p24 / exact - 1.0) < 1e-14);
}

TEST_CASE("E13: an entry of weight zero is never chosen", "[hard]") {
    const double middle[] = {0.0, 1.0, 0.0};
    const DiscreteDistribution d(middle);
    for (const float u : {0.0f, 1e-30f, 0.5f, kOneMinusUlp}) CHECK(d.sample(u).index == 1);
    CHECK(d.probability(0) == 0.0f);
    CHECK(d.probability(1) == 1.0f);
    const double one[] = {3.0};
    CHECK(DiscreteDistribution(one).sample(kOneMinusUlp).index == 0);
    const double none[] = {0.0, 0.0};
    CHECK(DiscreteDistribution(none).total() == 0.0);
    const double gaps[] = {0.0, 0.0, 2.0, 0.0, 0.0, 1e-30, 0.0};
    const DiscreteDistribution g(gaps);
    for (int i = 0; i < 1000; ++i) CHECK(g.sample(static_cast<float>(i) / 1000.0f).index == 2);
    CHECK(gaps[g.sample(kOneMinusUlp).index] > 0.0);
}

TEST_CASE("E14: a million equal weights end at 1, each with its share", "[hard]") {
    const std::vector<double> weights(1000003, double{0.1f});
    const DiscreteDistribution d(weights);
    for (const std::uint32_t i : {0u, 1u, 77777u, 500000u, 1000002u}) CHECK(d.probability(i) == Approx(1.0 / 1000003.0).epsilon(1e-6));
    CHECK(d.total() == Approx(1000003.0 * double{0.1f}).epsilon(1e-12));
    std::vector<double> mixed(std::size_t{1} << 24, 1e-8);
    mixed.insert(mixed.begin(), 1.0);
    CHECK(DiscreteDistribution(mixed).total() == Approx(1.0 + 0x1p24 * 1e-8).epsilon(1e-9));
}

TEST_CASE("E15: a cosine-weighted direction in the plane is no sample", "[hard]") {
    Bsdf b;
    b.kind = BsdfKind::diffuse;
    b.reflectance = Vec3f(1.0f);
    for (const float x : {0.0f, 0x1p-24f, 0.25f, 0.5f, kOneMinusUlp})
        for (const float y : {0.0f, 0x1p-24f, 0.25f, 0.5f, kOneMinusUlp}) {
            const BsdfSample s = sample_bsdf<EffectSet::all()>(b, {0, 0, 1}, 0.0f, {x, y});
            INFO("u " << x << " " << y << " z " << s.wi.z << " pdf " << s.pdf_w);
            CHECK(is_finite(s.weight));
            CHECK((s.pdf_w > 0.0f) == (max_component(s.weight) > 0.0f));
        }
}
