#pragma once
// Another layout of the same dimensions: each slot of a path reads those of another slot. What changes then is luck of dimensions.

#include <koksma/sampling/error.h>
#include <koksma/sampling/sample_source.h>

#include <cstddef>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace koksma {

/// Which slot's dimensions each slot of a layout reads: slot i those of slot `order[i]`, which has the same arity.
using SlotOrder = std::vector<std::size_t>;

/// A permutation of the slots among those of their arity, all equally likely (Fisher and Yates' shuffle). A pair stays a pair: it
/// gets two dimensions that the sampler was told are drawn jointly.
[[nodiscard]] inline SlotOrder permuted_slots(const DimensionLayout& layout, std::uint64_t seed) {
    const SlotRun slots = layout.slots();
    SlotOrder order(slots.size());
    for (const std::uint32_t arity : {1u, 2u}) {
        const Key key = derive_key(split_key(mix64(seed ^ 0x6c61796f757473ull)), arity);  // "layouts"
        std::vector<std::size_t> places;
        for (std::size_t i = 0; i < slots.size(); ++i)
            if (slots[i].arity == arity) places.push_back(i);
        std::vector<std::size_t> drawn = places;
        for (std::size_t n = drawn.size(); n > 1; --n) {
            const auto other = static_cast<std::size_t>((std::uint64_t{keyed_hash(key, static_cast<std::uint32_t>(n))} * n) >> 32);
            std::swap(drawn[n - 1], drawn[other]);
        }
        for (std::size_t k = 0; k < places.size(); ++k) order[places[k]] = drawn[k];
    }
    return order;
}

/// The layout as it stands, then `count - 1` permuted ones, no two of them equal.
/// @throws Error if the layout has too few slots for so many
[[nodiscard]] inline std::vector<SlotOrder> slot_orders(const DimensionLayout& layout, std::size_t count) {
    constexpr std::uint64_t kTriesEach = 64;
    SlotOrder as_it_stands(layout.slots().size());
    for (std::size_t i = 0; i < as_it_stands.size(); ++i) as_it_stands[i] = i;
    std::vector<SlotOrder> orders{std::move(as_it_stands)};
    for (std::uint64_t seed = 1; orders.size() < count; ++seed) {
        if (seed > kTriesEach * count)
            throw Error("only " + std::to_string(orders.size()) + " layouts were found of a path with " + std::to_string(layout.slots().size()) + " slots; " +
                        std::to_string(count) + " were asked for");
        SlotOrder order = permuted_slots(layout, seed);
        bool known = false;
        for (const SlotOrder& other : orders) known = known || other == order;
        if (!known) orders.push_back(std::move(order));
    }
    return orders;
}

/// A source whose slots are read in another order. The sampler beneath is bound to the layout as it stands, so its tables, its groups
/// and where its tail begins do not change; only who reads what. Slots are drawn one by one: its time says nothing of the sampler's.
class PermutedSource final : public SampleSource {
public:
    /// @param source  bound to a plan of `layout`
    PermutedSource(std::unique_ptr<SampleSource> source, const DimensionLayout& layout, const SlotOrder& order)
        : SampleSource(source->seed(), source->tail_dimension()), source_(std::move(source)), from_(layout.dimensions()) {
        for (std::size_t i = 0; i < order.size(); ++i) from_[layout.slots()[i].dimension] = layout.slots()[order[i]];
    }
    void fill(std::span<const SampleId> samples, SlotRun run, float* out, std::size_t stride) const noexcept override {
        for (const Slot& slot : run) source_->fill(samples, SlotRun(&from_[slot.dimension], 1), out + (slot.dimension - run.front().dimension) * stride, stride);
    }

private:
    std::unique_ptr<SampleSource> source_;
    std::vector<Slot> from_;  ///< by first dimension of the slot that reads
};

}  // namespace koksma
