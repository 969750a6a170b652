// Lookups: texel middles, wrapping, checkerboards, transforms of coordinates.

#include "describe.h"

#include <koksma/scene/texture.h>

#include <koksma_catch.h>

using namespace koksma;
using namespace koksma::testing;

namespace {

BitmapTexture bitmap(BitmapTexture::Filter filter, BitmapTexture::Wrap wrap) {
    BitmapTexture t;
    t.image = image(3, 2, {Rgb(0.0f), Rgb(1.0f), Rgb(2.0f), Rgb(3.0f), Rgb(4.0f), Rgb(5.0f)});
    t.filter = filter;
    t.wrap = wrap;
    return t;
}

using enum BitmapTexture::Filter;
using enum BitmapTexture::Wrap;

}  // namespace

TEST_CASE("both filters give the texel at its middle, row 0 at the top of v", "[scenes]") {
    for (const auto filter : {bilinear, nearest})
        for (const auto wrap : {repeat, mirror, clamp}) {
            const BitmapTexture t = bitmap(filter, wrap);
            for (int y = 0; y < 2; ++y)
                for (int x = 0; x < 3; ++x)
                    CHECK(lookup(t, {(static_cast<float>(x) + 0.5f) / 3.0f, (static_cast<float>(y) + 0.5f) / 2.0f}).x == Approx(static_cast<float>(3 * y + x)).margin(1e-5));
        }
}

TEST_CASE("bilinear lookups are linear between middles", "[scenes]") {
    const BitmapTexture t = bitmap(bilinear, clamp);
    CHECK(lookup(t, {1.0f / 3.0f, 0.25f}).x == Approx(0.5f));
    CHECK(lookup(t, {0.5f, 0.5f}).x == Approx(2.5f));
    CHECK(lookup(t, {0.0f, 0.0f}).x == Approx(0.0f).margin(1e-6));
}

TEST_CASE("coordinates outside wrap as the texture says", "[scenes]") {
    const float u = 1.0f + 0.5f / 3.0f, v = 0.25f;
    for (const auto filter : {bilinear, nearest}) {
        CHECK(lookup(bitmap(filter, repeat), {u, v}).x == Approx(0.0f).margin(1e-5));
        CHECK(lookup(bitmap(filter, mirror), {u, v}).x == Approx(2.0f).margin(1e-5));
        CHECK(lookup(bitmap(filter, clamp), {u, v}).x == Approx(2.0f).margin(1e-5));
        CHECK(lookup(bitmap(filter, repeat), {-0.5f / 3.0f, v}).x == Approx(2.0f).margin(1e-5));
        CHECK(lookup(bitmap(filter, mirror), {-0.5f / 3.0f, v}).x == Approx(0.0f).margin(1e-5));
        CHECK(lookup(bitmap(filter, clamp), {-5.0f, v}).x == Approx(0.0f).margin(1e-5));
        for (const auto wrap : {repeat, mirror, clamp})
            for (const float far : {-1e9f, 1e9f, 1e20f, -1e20f}) {
                const float x = lookup(bitmap(filter, wrap), {far, far}).x;
                CHECK(x >= 0.0f);
                CHECK(x <= 5.0f);
            }
    }
    // Half a texel over the edge, both neighbours.
    CHECK(lookup(bitmap(bilinear, repeat), {0.0f, v}).x == Approx(1.0f));
}

TEST_CASE("a checkerboard has color0 where both or neither are in the upper half", "[scenes]") {
    const CheckerboardTexture t;
    CHECK(lookup(t, {0.25f, 0.25f}).x == 0.4f);
    CHECK(lookup(t, {0.75f, 0.75f}).x == 0.4f);
    CHECK(lookup(t, {0.75f, 0.25f}).x == 0.2f);
    CHECK(lookup(t, {1.25f, 0.75f}).x == 0.2f);
    CHECK(lookup(t, {-0.25f, 0.75f}).x == 0.4f);
    CHECK(mean(t).x == Approx(0.3f));
}

TEST_CASE("to_uv acts on coordinates before the lookup", "[scenes]") {
    BitmapTexture t = bitmap(nearest, repeat);
    t.to_uv = glm::dmat3(2.0, 0, 0, 0, 1.0, 0, 1.0 / 3.0, 0, 1);  // u' = 2 u + 1/3
    CHECK(lookup(t, {0.1f, 0.25f}).x == 1.0f);
    CHECK(lookup(t, {0.2f, 0.75f}).x == 5.0f);
    CHECK(mean(Texture(t)).x == Approx(2.5f));
}
