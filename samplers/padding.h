#pragma once
// The option pad=none|2|4|all: what samplers with few dimensions do for a layout with more.

#include "joint_sets.h"

#include <koksma/sampling/sampler.h>

namespace koksma {

[[nodiscard]] inline OptionInfo pad_option(const char* default_value) {
    return {"pad", default_value, {}, "none: more dimensions than the file has are refused; 2, 4, all: use so many of them again, with an order and a scramble of their own"};
}

/// What the option says of a sampler with a file of so many dimensions.
inline void describe_padding(const std::string& pad, std::uint32_t dimensions, SamplerInfo& info) {
    if (pad == "none") info.max_dimensions = dimensions;
    info.joint = pad == "none" ? 0 : pad == "all" ? dimensions : pad == "4" ? 4 : 2;
}

/// The place of each dimension of a layout under the option `pad`: set 0 is drawn in the order of the file.
/// @param dimensions  that the file has
/// @throws Error when the value is unknown, the file has fewer dimensions than a set, or pad=none and the layout has more
[[nodiscard]] inline std::vector<JointPlace> padded_places(const SamplerOptions& options, const DimensionLayout& layout, std::uint32_t dimensions) {
    const std::string& pad = options["pad"];
    const std::string who = "sampler '" + options.canonical() + "'";
    const std::string has = " has " + std::to_string(dimensions) + " dimension" + (dimensions == 1 ? "" : "s");
    std::vector<JointPlace> places(layout.dimensions());
    if (pad == "none") {
        if (layout.dimensions() > dimensions)
            throw Error(who + has + "; the plan has " + std::to_string(layout.dimensions()) + " (pad=2, pad=4 or pad=all would use them again)");
        for (std::uint32_t d = 0; d < places.size(); ++d) places[d] = {0, d};
        return places;
    }
    if (pad != "2" && pad != "4" && pad != "all") throw Error(who + ": pad=" + pad + " is not one of its values: none, 2, 4, all");
    const std::uint32_t size = pad == "2" ? 2 : pad == "4" ? 4 : dimensions;
    if (size > dimensions) throw Error(who + has + "; pad=" + pad + " needs " + pad);
    if (size >= 2) return joint_sets(layout, size, false);
    for (std::uint32_t d = 0; d < places.size(); ++d) places[d] = {d, 0};
    return places;
}

}  // namespace koksma
