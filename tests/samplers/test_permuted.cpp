// Permuted layouts: who reads what changes, the numbers do not.

#include <koksma/sampling/permuted_source.h>
#include <koksma/sampling/registry.h>

#include <koksma_catch.h>

#include <algorithm>
#include <cstdlib>
#include <map>
#include <set>

using namespace koksma;

namespace {

/// A camera with a lens and three bounces of mixed arity.
DimensionLayout mixed_layout() {
    DimensionLayout layout;
    layout.add_camera(SlotRole::film, 2);
    layout.add_camera(SlotRole::lens, 2);
    for (int b = 0; b < 3; ++b) {
        layout.begin_bounce();
        layout.add_bounce(SlotRole::light_choice, 1);
        layout.add_bounce(SlotRole::light_position, 2);
        layout.add_bounce(SlotRole::lobe, 1);
        layout.add_bounce(SlotRole::direction, 2);
    }
    return layout;
}

std::vector<SampleId> samples() {
    std::vector<SampleId> ids;
    for (std::uint64_t i = 0; i < 37; ++i) ids.push_back({{3, 5}, i});
    return ids;
}

}  // namespace

TEST_CASE("permuted layouts are permutations that keep every slot's arity", "[unit][samplers]") {
    const DimensionLayout layout = mixed_layout();
    const std::vector<SlotOrder> orders = slot_orders(layout, 9);
    REQUIRE(orders.size() == 9);
    for (const SlotOrder& order : orders) {
        CHECK(std::set<std::size_t>(order.begin(), order.end()).size() == layout.slots().size());
        for (std::size_t i = 0; i < order.size(); ++i) CHECK(layout.slots()[order[i]].arity == layout.slots()[i].arity);
    }
    CHECK(std::is_sorted(orders.front().begin(), orders.front().end()));
    CHECK(std::set<SlotOrder>(orders.begin(), orders.end()).size() == 9);
    CHECK(permuted_slots(layout, 7) == permuted_slots(layout, 7));
}

TEST_CASE("every permutation of the pairs of a layout is as likely as every other", "[unit][samplers]") {
    const std::vector<std::uint8_t> arities{2, 2, 1, 2};
    const DimensionLayout layout = plain_layout(arities);
    std::map<SlotOrder, int> count;
    for (std::uint64_t seed = 0; seed < 6000; ++seed) ++count[permuted_slots(layout, seed)];
    REQUIRE(count.size() == 6);
    for (const auto& [order, n] : count) CHECK(std::abs(n - 1000) < 6 * 29);  // sd of a count: sqrt(6000 (1/6) (5/6)) = 29
}

TEST_CASE("layouts that do not exist are refused with their number", "[unit][samplers]") {
    const std::vector<std::uint8_t> arities{2, 1, 2};
    CHECK(slot_orders(plain_layout(arities), 2).size() == 2);
    CHECK_THROWS_AS(slot_orders(plain_layout(arities), 3), Error);
}

TEST_CASE("a permuted source draws for each slot what the sampler draws for the slot it stands for", "[unit][samplers]") {
    Registry registry;
    register_samplers(registry);
    const SamplingPlan plan{.spp = 64, .seed = 11, .layout = mixed_layout()};
    const SlotRun slots = plan.layout.slots();
    const std::vector<SampleId> ids = samples();
    const SlotOrder order = permuted_slots(plan.layout, 3);
    for (const char* name : {"random", "sobol", "sobol-4d", "stratified", "faure", "lattice"}) {
        const auto factory = registry.make(name);
        const auto plain = factory->bind(plan);
        const PermutedSource permuted(factory->bind(plan), plan.layout, order);
        const std::size_t n = ids.size(), stride = n + 3;
        std::vector<float> all(plan.layout.dimensions() * stride, -1.0f), one(2 * n);
        permuted.fill(ids, slots, all.data(), stride);
        for (std::size_t i = 0; i < slots.size(); ++i) {
            plain->fill(ids, SlotRun(&slots[order[i]], 1), one.data(), n);
            for (std::size_t k = 0; k < slots[i].arity; ++k)
                REQUIRE(std::equal(one.begin() + static_cast<std::ptrdiff_t>(k * n), one.begin() + static_cast<std::ptrdiff_t>((k + 1) * n),
                                   all.begin() + static_cast<std::ptrdiff_t>((slots[i].dimension + k) * stride)));
        }
        // A run from the middle, as integrators ask for it: the same numbers.
        const SlotRun run = plan.layout.bounce(1);
        std::vector<float> part(dimension_count(run) * stride, -1.0f);
        permuted.fill(ids, run, part.data(), stride);
        for (std::size_t d = 0; d < dimension_count(run); ++d)
            for (std::size_t i = 0; i < n; ++i) REQUIRE(part[d * stride + i] == all[(run.front().dimension + d) * stride + i]);
    }
}
