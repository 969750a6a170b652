// Plastics and rough glass under a constant sky of radiance 1.

#include "under_sky.h"

#include <scenes/layered_materials.h>

using namespace koksma;
using namespace koksma::testing;

namespace {

Plastic plastic(float albedo, bool nonlinear) {
    Plastic p;
    p.int_ior = 1.5f;
    p.ext_ior = 1.0f;
    p.diffuse_reflectance = Rgb(albedo);
    p.nonlinear = nonlinear;
    return p;
}

/// Reflectance of an interface to index n. Source: Fresnel
double fresnel(double degrees, double n) {
    const double ci = std::cos(glm::radians(degrees)), s = std::sin(glm::radians(degrees)) / n, ct = std::sqrt(1.0 - s * s);
    const double rs = (ci - n * ct) / (ci + n * ct), rp = (n * ci - ct) / (n * ci + ct);
    return 0.5 * (rs * rs + rp * rp);
}

}  // namespace

TEST_CASE("C10: plastic reflects F + (1 - F) albedo, and all of the sky where the albedo is 1", "[hard][render]") {
    struct Row {
        double degrees, linear, nonlinear;
    };
    for (const Row& row : {Row{0.0, 0.52, 0.316070886659}, Row{60.0, 0.544593356401, 0.351112787571},
                           Row{85.0, 0.806399822632, 0.72414833823}, Row{89.9, 0.99495593846, 0.992812957215}}) {
        const double f = fresnel(row.degrees, 1.5);
        INFO("angle " << row.degrees);
        CHECK(row.linear == Approx(f + 0.5 * (1.0 - f)).epsilon(1e-9));
        check_mean(measure(plane_under_sky(plastic(0.5f, false), row.degrees), 4096, 8), row.linear, 2e-3);
        check_mean(measure(plane_under_sky(plastic(0.5f, true), row.degrees), 4096, 8), row.nonlinear, 2e-3);
        check_mean(measure(plane_under_sky(plastic(1.0f, false), row.degrees), 4096, 8), 1.0, 2e-3);
        check_mean(measure(plane_under_sky(plastic(1.0f, true), row.degrees), 4096, 8), 1.0, 2e-3);
    }
}

TEST_CASE("C11: a rough glass sphere loses what its model loses", "[hard][render]") {
    const auto sphere = [](Facets distribution, float alpha) {
        SceneDescription d = shape_under_sky(SphereShape{}, rough_glass(distribution, alpha, alpha));
        look_narrowly(d, {0.2, 0.3, -4}, {0, 0, 0}, 10.0);
        return d;
    };
    for (const Facets distribution : {Facets::ggx, Facets::beckmann}) check_mean(measure(sphere(distribution, 1e-3f), 1024, 8), 1.0, 1e-3);
    // There is no closed form: Mitsuba 3.9.1, scalar_rgb, 4 x 4 pixels of 24576 samples, standard errors up to 6e-4; both within 0.003.
    struct Row {
        Facets distribution;
        float alpha;
        double expected;
    };
    for (const Row& row :
         {Row{Facets::ggx, 0.01f, 1.0}, Row{Facets::ggx, 0.1f, 0.98378}, Row{Facets::ggx, 0.5f, 0.67342}, Row{Facets::ggx, 1.0f, 0.36267},
          Row{Facets::beckmann, 0.1f, 0.99982}, Row{Facets::beckmann, 0.5f, 0.90200}, Row{Facets::beckmann, 1.0f, 0.54329}}) {
        INFO("facets " << static_cast<int>(row.distribution) << " alpha " << row.alpha);
        check_mean(measure(sphere(row.distribution, row.alpha), 2048, 8), row.expected, 3e-3 / row.expected);
    }
}

TEST_CASE("C12: rough glass vanishes as its index nears 1", "[hard][render]") {
    for (const Facets distribution : {Facets::ggx, Facets::beckmann})
        for (const float alpha : {1e-4f, 1e-3f})
            for (const double excess : {0.0, 2e-7, 1e-6, 1e-5}) {
                INFO("facets " << static_cast<int>(distribution) << " alpha " << alpha << " index 1 + " << excess);
                check_mean(
                    measure(shape_under_sky(SphereShape{}, rough_glass(distribution, alpha, alpha, static_cast<float>(1.0 + excess))), 64,
                            4),
                    1.0, 3e-3);
                check_mean(
                    measure(shape_under_sky(SphereShape{}, rough_glass(distribution, alpha, alpha, 1.0f, static_cast<float>(1.0 + excess))),
                            64, 4),
                    1.0, 3e-3);
            }
}
