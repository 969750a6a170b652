// Mixed sources: each slot gets the bits of its own source, and the error splits as the Sobol' indices say.

#include <koksma/sampling/mixed_source.h>
#include <koksma/sampling/registry.h>

#include <koksma_catch.h>

#include <cmath>
#include <cstdint>

using namespace koksma;

namespace {

DimensionLayout three_slots() {
    const std::vector<std::uint8_t> arities{2, 1, 2};
    return plain_layout(arities);
}

std::vector<SampleId> samples(std::uint64_t n) {
    std::vector<SampleId> ids;
    for (std::uint64_t i = 0; i < n; ++i) ids.push_back({{3, 5}, i});
    return ids;
}

std::vector<float> drawn(const SampleSource& source, const DimensionLayout& layout, std::uint64_t n) {
    std::vector<float> out(n * layout.dimensions());
    const auto ids = samples(n);
    source.fill(ids, layout.slots(), out.data(), n);
    return out;
}

}  // namespace

TEST_CASE("every slot of a mixed source has the bits of the source it reads", "[unit][samplers]") {
    Registry registry;
    register_samplers(registry);
    const DimensionLayout layout = three_slots();
    constexpr std::uint64_t kSamples = 37;
    const auto bind = [&](const char* spec, std::uint64_t seed) { return registry.make(spec)->bind({16, 16, kSamples, seed, layout}); };
    const std::vector<float> sobol = drawn(*bind("sobol", 1), layout, kSamples), random = drawn(*bind("random", 2), layout, kSamples);
    for (unsigned bits = 0; bits < 8; ++bits) {
        const SlotSet set{(bits & 1) != 0, (bits & 2) != 0, (bits & 4) != 0};
        const MixedSource mixed(bind("sobol", 1), bind("random", 2), layout, set);
        const std::vector<float> got = drawn(mixed, layout, kSamples);
        for (std::size_t s = 0; s < 3; ++s)
            for (std::uint32_t k = 0; k < layout.slots()[s].arity; ++k)
                for (std::size_t i = 0; i < kSamples; ++i) {
                    const std::size_t at = (layout.slots()[s].dimension + k) * kSamples + i;
                    REQUIRE(got[at] == (set[s] ? random : sobol)[at]);
                }
    }
}

TEST_CASE("a constant source is constant", "[unit][samplers]") {
    const DimensionLayout layout = three_slots();
    for (const float v : drawn(ConstantSource(0.5f, 0), layout, 7)) CHECK(v == 0.5f);
}

// f = (1 + a (x - 1/2)) (1 + b (y - 1/2)): the variance of x alone is a^2/12, of y alone b^2/12, of both together a^2 b^2/144. With only x
// by the sequence N MSE tends to the variance without that of x alone; with only x independent to all variance in which x has a part.
TEST_CASE("a mixture's error is what the Sobol' indices leave", "[unit][samplers]") {
    Registry registry;
    register_samplers(registry);
    const std::vector<std::uint8_t> arities{1, 1};
    const DimensionLayout layout = plain_layout(arities);
    constexpr double a = 1.5, b = 1.0, vx = a * a / 12, vy = b * b / 12, vxy = vx * vy;
    constexpr std::uint64_t kSamples = 1024, kReplicates = 4000;
    const auto n_mse = [&](bool x_independent, bool y_independent) {
        double sum = 0;
        for (std::uint64_t r = 0; r < kReplicates; ++r) {
            const auto bind = [&](const char* spec, std::uint64_t seed) {
                return registry.make(spec)->bind({16, 16, kSamples, seed, layout});
            };
            const MixedSource source(bind("sobol:randomize=owen", r), bind("random", r + (1ull << 40)), layout,
                                     {x_independent, y_independent});
            const std::vector<float> u = drawn(source, layout, kSamples);
            double mean = 0;
            for (std::size_t i = 0; i < kSamples; ++i)
                mean += (1 + a * (double(u[i]) - 0.5)) * (1 + b * (double(u[kSamples + i]) - 0.5)) / kSamples;
            sum += (mean - 1) * (mean - 1);
        }
        return sum / kReplicates * kSamples;
    };
    const double relative_sd = std::sqrt(2.0 / kReplicates);  // of a mean of squares of normals: 2.2 %; 4 sd below
    const auto near = [&](double value, double expected) { CHECK(std::abs(value / expected - 1) < 4 * relative_sd); };
    near(n_mse(true, true), vx + vy + vxy);
    near(n_mse(false, true), vy + vxy);
    near(n_mse(true, false), vx + vxy);
    CHECK(n_mse(false, false) < 0.01 * vxy);
}
