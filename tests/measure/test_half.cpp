#include <koksma/measure/reference.h>
#include <koksma/sampling/error.h>
#include <koksma_catch.h>

#include <sstream>
#include <vector>

using namespace koksma;

TEST_CASE("the sums of a half that are written and read go on with the same bits", "[unit][measure]") {
    const std::vector<std::vector<float>> images = {{0.1f, 2.0f, 1e-7f}, {0.3f, 2.5f, 3e-7f}, {0.7f, 1.9f, 1e9f}};
    HalfAccumulator whole, stepped;
    for (const auto& image : images) {
        whole.add(image);
        stepped.add(image);
        std::stringstream file;
        stepped.write(file);
        stepped = HalfAccumulator::read(file);
    }
    CHECK(stepped.replicates() == 3);
    CHECK(stepped.finish("x", 4).mean == whole.finish("x", 4).mean);
    CHECK(stepped.finish("x", 4).variance == whole.finish("x", 4).variance);
    std::stringstream file;
    whole.write(file);
    std::string text = file.str();
    std::istringstream shorter(text.substr(0, text.size() - 1)), other("something else entirely, long enough");
    CHECK_THROWS_AS(HalfAccumulator::read(shorter), Error);
    CHECK_THROWS_AS(HalfAccumulator::read(other), Error);
}
