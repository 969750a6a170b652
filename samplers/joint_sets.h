#pragma once
// Which dimensions of a layout a padded sampler draws together.

#include <koksma/sampling/layout.h>

#include <vector>

namespace koksma {

/// The place of a dimension: its set (named by the first dimension of the set) and its number within.
struct JointPlace {
    std::uint32_t set = 0, within = 0;
};

/// Sets of consecutive slots, filled in the order of the layout. A set ends where the next slot would make it larger than
/// `size` dimensions, and, with `by_group`, where the slot's group changes (camera, or bounce). Within a set the 2-D slots
/// come first: they get the dimensions (0, 1), (2, 3), .. of the sequence.
/// @param size  at least 2
/// @return      the place of each dimension of the layout
[[nodiscard]] inline std::vector<JointPlace> joint_sets(const DimensionLayout& layout, std::uint32_t size, bool by_group) {
    std::vector<JointPlace> places(layout.dimensions());
    const SlotRun slots = layout.slots();
    std::size_t begin = 0;
    while (begin < slots.size()) {
        const std::uint32_t first = slots[begin].dimension;
        std::size_t end = begin;
        while (end < slots.size() && slots[end].dimension + slots[end].arity - first <= size &&
               !(by_group && slots[end].group != slots[begin].group))
            ++end;
        std::uint32_t within = 0;
        for (const std::uint32_t arity : {2u, 1u})
            for (const Slot& slot : slots.subspan(begin, end - begin))
                for (std::uint32_t k = 0; slot.arity == arity && k < arity; ++k) places[slot.dimension + k] = {first, within++};
        begin = end;
    }
    return places;
}

}  // namespace koksma
