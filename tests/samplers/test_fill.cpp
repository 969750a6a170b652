// Vectorised fills against the points they stand for.

#include <koksma/sampling/registry.h>
#include <koksma/simd/targets.h>

#include <koksma_catch.h>

#include <algorithm>
#include <random>

using namespace koksma;

namespace {

/// Every sampler with a fill of its own, with every combination of the options that have a list of values.
std::vector<std::string> vectorised_specs(const Registry& registry) {
    std::vector<std::string> out;
    for (const SamplerInfo& info : registry.infos()) {
        if (!registry.vectorised(info.name)) continue;
        std::vector<std::string> specs{info.name + ":"};
        for (const OptionInfo& o : info.options) {
            if (o.values.empty()) continue;
            std::vector<std::string> longer;
            for (const std::string& s : specs)
                for (const std::string& v : o.values) longer.push_back(s + (s.back() == ':' ? "" : ",") + o.name + "=" + v);
            specs = longer;
        }
        for (std::string& s : specs) out.push_back(s.back() == ':' ? info.name : s);
    }
    return out;
}

/// What a batch may look like: stretches of pixels, of all lengths and with gaps, and indices of any size.
std::vector<SampleId> some_samples(std::mt19937_64& random, std::size_t count, std::uint64_t end) {
    const auto below = [&](std::uint64_t n) { return random() % n; };
    std::vector<SampleId> ids;
    const std::uint64_t starts[] = {0, 0, 0, 13, 250, 4090, 65530, (1u << 21) - 40, (1u << 24) - 20, (1ull << 26) - 30, (1ull << 31) - 9, (1ull << 32) - 50, (1ull << 32) + 5,
                                    (1ull << 40) + 12345, (1ull << 63) - 70, ~0ull - 300};
    const std::size_t kind = below(4);
    while (ids.size() < count) {
        const Pixel pixel{static_cast<std::int32_t>(below(2048)), static_cast<std::int32_t>(below(2048))};
        const std::uint64_t length = kind == 0 ? 1 : 1 + below(kind == 1 ? 6 : 100), gap = below(3) == 0 ? 4 : 1;
        std::uint64_t index = std::min(starts[below(std::size(starts))], end - 1);
        for (std::uint64_t k = 0; k < length && ids.size() < count; ++k, index += 1 + below(gap)) ids.push_back({pixel, std::min(index, end - 1)});
    }
    if (kind == 3) std::shuffle(ids.begin(), ids.end(), random);
    return ids;
}

/// Runs at the first, the middle and the last dimensions that a sampler has, and across its last.
std::vector<SlotRun> some_runs(std::mt19937_64& random, const DimensionLayout& layout, std::uint32_t max_dimensions) {
    const SlotRun all = layout.slots();
    std::vector<SlotRun> runs;
    const auto run_at = [&](std::size_t slot) { runs.push_back(all.subspan(slot, std::min<std::size_t>(1 + random() % 6, all.size() - slot))); };
    run_at(0);
    run_at(random() % 20);
    run_at(random() % all.size());
    for (const std::uint32_t dimension : {1022u, max_dimensions - 7, max_dimensions - 2})
        for (std::size_t s = 0; s < all.size(); ++s)
            if (all[s].dimension >= dimension) {
                run_at(s);
                break;
            }
    return runs;
}

std::string difference(const SampleSource& source, std::span<const SampleId> ids, SlotRun run, std::size_t stride) {
    std::vector<float> fast(dimension_count(run) * stride, -1.0f), plain = fast;
    source.fill(ids, run, fast.data(), stride);
    source.fill_scalar(ids, run, plain.data(), stride);
    for (std::size_t k = 0; k < fast.size(); ++k) {
        if (std::bit_cast<std::uint32_t>(fast[k]) == std::bit_cast<std::uint32_t>(plain[k])) continue;
        const SampleId id = ids[std::min(k % stride, ids.size() - 1)];
        return "dimension " + std::to_string(run.front().dimension + k / stride) + ", place " + std::to_string(k % stride) + " of " + std::to_string(ids.size()) +
               ", index " + std::to_string(id.index) + ": fill gives " + std::to_string(fast[k]) + ", point " + std::to_string(plain[k]);
    }
    return {};
}

/// All samplers of the registry, on the instruction set in use.
void check_fills(const std::string& target) {
    Registry registry;
    register_samplers(registry);
    std::mt19937_64 random(7);
    for (const std::string& spec : vectorised_specs(registry)) {
        const auto factory = registry.make(spec);
        const SamplerInfo& info = factory->info();
        for (int round = 0; round < 12; ++round) {
            // Slots of one, of two, and of both.
            std::vector<std::uint8_t> arities;
            const std::uint32_t dimensions = std::min<std::uint32_t>(info.max_dimensions, 4096) + 8;
            for (std::uint32_t d = 0; d < dimensions; d += arities.back()) arities.push_back(static_cast<std::uint8_t>(round % 3 == 2 ? 1 + random() % 2 : 1 + round % 3));
            const std::uint64_t counts[] = {64, 1, 2, 3, 7, 16, 17, 60, 100, 101, 1024, 4096, 5000, 65535, 65536, 65537};
            SamplingPlan plan{.film_width = 2048, .film_height = 2048, .spp = std::min(counts[random() % std::size(counts)], info.max_samples), .seed = random(), .layout = plain_layout(arities)};
            const auto source = factory->bind(plan);
            REQUIRE(source->vectorised());
            for (const SlotRun run : some_runs(random, plan.layout, info.max_dimensions)) {
                const std::size_t count = round == 0 ? 600 : 1 + random() % 200;
                const std::uint64_t end = random() % 2 == 0 ? plan.spp : info.max_samples;
                const std::vector<SampleId> ids = some_samples(random, count + 3, end);
                const std::string found = difference(*source, std::span(ids).subspan(random() % 4, count), run, count + random() % 5);
                INFO(target << " " << spec << " spp " << plan.spp << ": " << found);
                REQUIRE(found.empty());
            }
        }
    }
}

}  // namespace

TEST_CASE("Vectorised fills give the bits of their points, on every instruction set", "[unit][samplers]") {
    for (const std::string& target : simd::targets()) {
        simd::use_target(target);
        check_fills(target);
    }
    simd::use_target("");
}

TEST_CASE("A fill of no samples, or of no slots, writes nothing", "[unit][samplers]") {
    Registry registry;
    register_samplers(registry);
    for (const std::string& spec : vectorised_specs(registry)) {
        const SamplingPlan plan{.layout = plain_layout(std::vector<std::uint8_t>(4, 2))};
        const auto source = registry.make(spec)->bind(plan);
        const SampleId id{};
        float out = -1;
        source->fill({}, plan.layout.slots(), &out, 0);
        source->fill({&id, 1}, {}, &out, 1);
        REQUIRE(out == -1);
    }
}
