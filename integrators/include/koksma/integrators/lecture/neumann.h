#pragma once
// Radiance sorted by how often the light was scattered on its way: the terms of the Neumann series.

#include <koksma/math/vec3.h>

#include <array>
#include <cstddef>

namespace koksma {

/// L = E + T E + T^2 E + ...: term k is light that was scattered k times. Le is term 0, Ldirect term 1, Lindirect the sum of the others.
/// The last term gathers the rest of the series.
/// Source: Kajiya 1986, "The rendering equation", section 3; Arvo and Kirk 1990, "Particle transport and image synthesis"
struct NeumannSeries {
    static constexpr std::size_t kTerms = 8;
    std::array<Vec3f, kTerms> term{};

    /// Adds light that arrives at a surface and is scattered once more by it.
    /// @param weight  f |cos| / pdf of the direction from which it arrives
    void add_scattered(Vec3f weight, const NeumannSeries& arriving) noexcept {
        for (std::size_t k = 0; k < kTerms; ++k) term[k + 1 < kTerms ? k + 1 : k] += weight * arriving.term[k];
    }
    [[nodiscard]] Vec3f total() const noexcept {
        Vec3f sum{0.0f};
        for (const Vec3f& t : term) sum += t;
        return sum;
    }
};

}  // namespace koksma
