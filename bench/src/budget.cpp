#include "budget.h"

#include <koksma/measure/metrics.h>
#include <koksma/measure/seeds.h>

#include <fmt/format.h>

#include <algorithm>
#include <map>

namespace koksma {

namespace {

/// Adds a slot to the group of that name, in order of first appearance.
void add_to(Division& division, const std::string& name, std::size_t slot, std::size_t slots) {
    auto at = std::find_if(division.groups.begin(), division.groups.end(), [&](const SlotGroup& g) { return g.name == name; });
    if (at == division.groups.end()) at = division.groups.insert(at, {name, SlotSet(slots)});
    at->slots[slot] = true;
}

SlotSet complement(SlotSet set) {
    set.flip();
    return set;
}

}  // namespace

std::vector<Division> divisions_of(const DimensionLayout& layout, std::size_t bounces) {
    Division by_role{"role", {}}, by_bounce{"bounce", {}}, by_both{"role and bounce", {}};
    const SlotRun slots = layout.slots();
    const std::size_t camera = layout.camera().size();
    for (std::size_t i = 0; i < slots.size(); ++i) {
        const std::string role(name(slots[i].role));
        const std::string bounce = i < camera ? "camera"
                                   : slots[i].bounce < bounces || layout.bounce_count() == bounces + 1
                                       ? fmt::format("bounce {}", slots[i].bounce)
                                       : fmt::format("bounce {} and later", bounces);
        add_to(by_role, role, i, slots.size());
        add_to(by_bounce, bounce, i, slots.size());
        add_to(by_both, i < camera ? role : role + ", " + bounce, i, slots.size());
    }
    return {by_role, by_bounce, by_both};
}

Budget measure_budget(const BenchScene& s, const Reference& reference, const SamplerFactory& sequence, const SamplerFactory& independent,
                      const BudgetSettings& settings, const std::function<void(double)>& progress) {
    Budget budget;
    budget.divisions = divisions_of(s.plan.layout, settings.bounces);
    const std::size_t slots = s.plan.layout.slots().size();

    // By the slots that are independent; all of them are known before the first is rendered.
    std::map<SlotSet, std::vector<double>> measured{{SlotSet(slots, true), {}}, {SlotSet(slots, false), {}}};
    for (const Division& d : budget.divisions)
        for (const SlotGroup& g : d.groups) measured[g.slots], measured[complement(g.slots)];

    RenderOptions options;
    options.threads = settings.threads;
    std::size_t done = 0;
    for (auto& [set, errors] : measured) {
        const std::string key = sequence.name() + ", independent: " + std::string([&] {
                                    std::string bits;
                                    for (const bool b : set) bits += b ? '1' : '0';
                                    return bits;
                                }());
        for (int r = 0; r < settings.replicates; ++r) {
            const auto seed = [&](const char* which) {
                return test_seed(settings.seed, s.key.scene_hash, which + key, settings.spp, static_cast<std::uint64_t>(r));
            };
            const MixedSource source(sequence.bind(sampling_plan(s.scene, s.plan, settings.spp, seed("sequence: "))),
                                     independent.bind(sampling_plan(s.scene, s.plan, settings.spp, seed("independent: "))), s.plan.layout,
                                     set);
            const std::vector<float> image = render(s.scene, s.plan, source, {s.what.crop, 0, settings.spp}, options).film.image();
            errors.push_back(compare_to_reference(image, reference.mean, reference.variance).mse);
        }
        progress(static_cast<double>(++done) / static_cast<double>(measured.size()));
    }

    budget.independent = measured.at(SlotSet(slots, true));
    budget.sequence = measured.at(SlotSet(slots, false));
    for (const Division& d : budget.divisions) {
        budget.groups.emplace_back();
        for (const SlotGroup& g : d.groups) budget.groups.back().push_back({measured.at(complement(g.slots)), measured.at(g.slots)});
    }
    return budget;
}

Gain share(const std::vector<double>& a, const std::vector<double>& b) {
    Gain g = gain(b, a);  // MSE(a) / MSE(b)
    g.value = 1.0 - g.value;
    const double lo = 1.0 - g.hi;
    g.hi = 1.0 - g.lo;
    g.lo = lo;
    return g;
}

}  // namespace koksma
