#pragma once
// <bsdf>: diffuse, dielectric, conductor, roughconductor, twosided.

#include "context.h"

namespace koksma::loader {

/// Index of the material of a <bsdf> element, added on first use. @throws Error
[[nodiscard]] std::uint32_t material_of(const Element& bsdf, Context& context);

/// The whole of a <bsdf> element, not added to the scene. @throws Error
[[nodiscard]] Material parse_material(const Element& bsdf, Context& context);

/// Index of the black material: what Mitsuba gives to a light without a BSDF.
[[nodiscard]] std::uint32_t black_material(Context& context);

}  // namespace koksma::loader
