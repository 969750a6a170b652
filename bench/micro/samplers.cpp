// Cost of each sampler: CPU time per number, through the interface that the kernels use.
//
//     <span>/<slots>/<fill>/<sampler>
//
// span   pixel: 64 samples of one pixel a call; film: 64 samples of each of 64 pixels a call; path: as film, but of each pixel
//        only the samples that are alive after some bounces (20 to 50 of 64) remain, and a call draws the slots of one bounce
// slots  2d, 1d: 32 dimensions in slots of so many (path: three slots)
// fill   point: one sample after the other, by the sampler's `point`; vector: its own fill. A sampler without the latter has
//        no second row
//
// The counter ns_per_number is the result. KOKSMA_TARGET=AVX2 (koksma/simd/targets.h) in the environment limits the instruction set.

#include <koksma/sampling/registry.h>
#include <koksma/simd/targets.h>

#include <benchmark/benchmark.h>

#include <cstdlib>
#include <random>
#include <string>
#include <vector>

namespace {

using namespace koksma;

/// Every sampler with every value of its options that have a list of them, one changed at a time; `pixels` costs nothing.
std::vector<std::string> specs(const Registry& registry) {
    std::vector<std::string> out;
    for (const SamplerInfo& info : registry.infos()) {
        out.push_back(info.name);
        for (const OptionInfo& o : info.options)
            if (o.name != "pixels")
                for (const std::string& v : o.values)
                    if (v != o.default_value) out.push_back(info.name + ":" + o.name + "=" + v);
    }
    return out;
}

enum class Span { pixel, film, path };

std::vector<SampleId> samples_of(Span span) {
    constexpr std::uint64_t kSamples = 64;
    std::vector<SampleId> ids;
    std::mt19937 random(1);
    for (std::int32_t p = 0; p < (span == Span::pixel ? 1 : 64); ++p) {
        const double alive = span == Span::path ? std::uniform_real_distribution<>(20, 50)(random) / kSamples : 1.0;
        for (std::uint64_t i = 0; i < kSamples; ++i)
            if (std::uniform_real_distribution<>()(random) < alive) ids.push_back({{p % 8, p / 8}, i});
    }
    return ids;
}

struct Case {
    std::string sampler;
    Span span = Span::pixel;
    std::uint8_t arity = 2;
    bool vector = false;
};

void fill(benchmark::State& state, const Registry& registry, const Case& c) {
    const std::vector<std::uint8_t> arities(32 / c.arity, c.arity);
    SamplingPlan plan;
    plan.film_width = plan.film_height = 256;
    plan.spp = 64;
    plan.seed = 1;
    plan.layout = plain_layout(arities);
    const auto source = registry.make(c.sampler)->bind(plan);
    const SlotRun run = c.span == Span::path ? plan.layout.slots().subspan(8, 3) : plan.layout.slots();
    std::vector<SampleId> ids = samples_of(c.span);
    std::vector<float> out(ids.size() * dimension_count(run));
    for ([[maybe_unused]] auto iteration : state) {
        for (SampleId& id : ids) id.pixel.x = (id.pixel.x + 8) & 255;
        if (c.vector)
            source->fill(ids, run, out.data(), ids.size());
        else
            source->fill_scalar(ids, run, out.data(), ids.size());
        benchmark::DoNotOptimize(out.data());
        benchmark::ClobberMemory();
    }
    const double numbers = static_cast<double>(state.iterations()) * static_cast<double>(out.size());
    state.counters["ns_per_number"] = benchmark::Counter(numbers * 1e-9, benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
}

}  // namespace

int main(int argc, char** argv) {
    benchmark::Initialize(&argc, argv);
    if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;
    if (const char* target = std::getenv("KOKSMA_TARGET")) koksma::simd::use_target(target);
    benchmark::AddCustomContext("instruction set", koksma::simd::target());
    koksma::Registry registry;
    koksma::register_samplers(registry);
    for (const std::string& spec : specs(registry))
        for (const auto& [span, name] : {std::pair{Span::pixel, "pixel"}, {Span::film, "film"}, {Span::path, "path"}})
            for (const std::uint8_t arity : {std::uint8_t{2}, std::uint8_t{1}})
                for (const bool vector : {false, true}) {
                    if (vector && !registry.vectorised(spec.substr(0, spec.find(':')))) continue;
                    const std::string row = std::string(name) + (arity == 2 ? "/2d/" : "/1d/") + (vector ? "vector/" : "point/") + spec;
                    benchmark::RegisterBenchmark(row.c_str(), [&registry, c = Case{spec, span, arity, vector}](benchmark::State& state) { fill(state, registry, c); });
                }
    benchmark::RunSpecifiedBenchmarks();
    benchmark::Shutdown();
    return 0;
}
