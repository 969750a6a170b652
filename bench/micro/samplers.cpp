// Cost of each sampler: CPU time per number, through the batch interface that the kernels use.
// items_per_second counts numbers (one dimension of one sample).

#include <koksma/sampling/registry.h>

#include <benchmark/benchmark.h>

#include <string>
#include <vector>

namespace {

using namespace koksma;

/// Every sampler with every value of its randomisation.
std::vector<std::string> specs(const Registry& registry) {
    std::vector<std::string> out;
    for (const SamplerInfo& info : registry.infos()) {
        bool any = false;
        for (const OptionInfo& o : info.options)
            if (o.name == "randomize")
                for (const std::string& v : o.values) {
                    out.push_back(info.name + ":randomize=" + v);
                    any = true;
                }
        if (!any) out.push_back(info.name);
    }
    return out;
}

/// Fills 32 dimensions (16 slots of two) of 64 samples of a pixel, pixel after pixel.
void fill(benchmark::State& state, const Registry& registry, const std::string& spec) {
    constexpr std::size_t kSamples = 64;
    const std::vector<std::uint8_t> arities(16, 2);
    SamplingPlan plan;
    plan.film_width = plan.film_height = 256;
    plan.spp = kSamples;
    plan.seed = 1;
    plan.layout = plain_layout(arities);
    const auto source = registry.make(spec)->bind(plan);
    std::vector<SampleId> ids(kSamples);
    std::vector<float> out(kSamples * plan.layout.dimensions());
    std::int32_t pixel = 0;
    for ([[maybe_unused]] auto iteration : state) {
        for (std::size_t i = 0; i < kSamples; ++i) ids[i] = {{pixel & 255, (pixel >> 8) & 255}, i};
        ++pixel;
        source->fill(ids, plan.layout.slots(), out.data(), kSamples);
        benchmark::DoNotOptimize(out.data());
        benchmark::ClobberMemory();
    }
    state.SetItemsProcessed(static_cast<std::int64_t>(state.iterations()) * static_cast<std::int64_t>(out.size()));
}

}  // namespace

int main(int argc, char** argv) {
    benchmark::Initialize(&argc, argv);
    if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;
    koksma::Registry registry;
    koksma::register_samplers(registry);
    for (const std::string& spec : specs(registry))
        benchmark::RegisterBenchmark(("fill/" + spec).c_str(), [&registry, spec](benchmark::State& state) { fill(state, registry, spec); });
    benchmark::RunSpecifiedBenchmarks();
    benchmark::Shutdown();
    return 0;
}
