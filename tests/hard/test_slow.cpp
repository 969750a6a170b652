// Rows whose paths are very long.

#include <scenes/render_scene.h>

using namespace koksma;
using namespace koksma::testing;

TEST_CASE("A2: a thousand terms of the series at albedo 0.999", "[hard][render]") {
    SceneDescription d = furnace(CubeShape{}, Matrix(1.0), 0.999f, 0.001f);
    d.integrator.max_depth = 1000;
    d.integrator.rr_depth = 1 << 20;
    check_mean(measure(d, 32, 8), 1.0 - std::pow(double{0.999f}, 1000), 2e-3);
}

TEST_CASE("A3: roulette keeps its mean and its variance at albedo 0.999", "[hard][render]") {
    const Measured m = measure(furnace(CubeShape{}, Matrix(1.0), 0.999f, 0.001f), 256, 8, "random");
    check_mean(m, 1.0, 2e-2);
}
