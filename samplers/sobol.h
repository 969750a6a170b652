#pragma once
// sobol: the Sobol' sequence with the direction numbers of Joe and Kuo, and its randomisations.
// Source: Sobol' 1967; S. Joe and F. Y. Kuo 2008, "Constructing Sobol' sequences with better two-dimensional projections",
// SIAM J. Sci. Comput. 30, 2635-2654 (table new-joe-kuo-6); Owen scrambling: owen_hash.h.

#include "pixel_keys.h"

#include <koksma/sampling/owen_hash.h>

#include <array>

namespace koksma {

inline constexpr std::uint32_t kSobolDimensions = 4096;

/// The generator matrices in the form that evaluation wants: for every four digits of the index, the xor of the columns
/// that each of their 16 values selects. One cache line each; entries are bit-reversed (bit 0 is the digit of 1/2).
struct alignas(64) SobolNibble {
    std::array<std::uint32_t, 16> entry_rev{};
};
inline constexpr std::uint32_t kSobolNibbles = 16;  // 64 columns: any 64-bit index

/// Row of dimension d, nibble k of the index: [d * kSobolNibbles + k]. Built at the first call (4 MiB); thread-safe.
[[nodiscard]] const SobolNibble* sobol_matrices();

/// Direction number of a column: the 32 leading digits of its fraction, most significant in bit 31.
/// @param dimension  below 4096
/// @param column     below 64: which binary digit of the index selects it
[[nodiscard]] std::uint32_t sobol_direction(std::uint32_t dimension, std::uint32_t column);

/// Coordinate of a point, unscrambled and bit-reversed.
[[nodiscard]] inline std::uint32_t sobol_rev(const SobolNibble* matrices, std::uint64_t index, std::uint32_t dimension) noexcept {
    std::uint32_t x = 0;
    for (const SobolNibble* row = matrices + std::size_t{dimension} * kSobolNibbles; index != 0; index >>= 4, ++row)
        x ^= row->entry_rev[index & 15u];
    return x;
}

class SobolSampler {
public:
    enum class Randomize : std::uint8_t { none, digital_shift, owen, owen_tree };

    class Point {
    public:
        Point(const SobolNibble* matrices, Key key, std::uint64_t index, Randomize randomize) noexcept
            : matrices_(matrices), index_(index), key_(key), randomize_(randomize) {}

        [[nodiscard]] float get_1d(const Slot& slot) const noexcept {
            return value(sobol_rev(matrices_, index_, slot.dimension), slot.dimension);
        }
        [[nodiscard]] glm::vec2 get_2d(const Slot& slot) const noexcept {
            std::uint32_t x = 0, y = 0;
            const SobolNibble* row = matrices_ + std::size_t{slot.dimension} * kSobolNibbles;
            for (std::uint64_t i = index_; i != 0; i >>= 4, ++row) {
                x ^= row->entry_rev[i & 15u];
                y ^= row[kSobolNibbles].entry_rev[i & 15u];
            }
            return {value(x, slot.dimension), value(y, slot.dimension + 1)};
        }

    private:
        [[nodiscard]] float value(std::uint32_t x_rev, std::uint32_t dimension) const noexcept {
            switch (randomize_) {
                case Randomize::none: break;
                case Randomize::digital_shift: x_rev ^= keyed_hash(key_, dimension); break;
                case Randomize::owen: x_rev = owen_hash_rev(x_rev, keyed_hash(key_, dimension)); break;
                case Randomize::owen_tree: return unit_float(owen_tree(reverse_bits(x_rev), derive_key(key_, dimension)));
            }
            return unit_float(reverse_bits(x_rev));
        }
        const SobolNibble* matrices_;
        std::uint64_t index_;
        Key key_;
        Randomize randomize_;
    };

    [[nodiscard]] static SamplerInfo info();
    SobolSampler(const SamplerOptions& options, const SamplingPlan& plan);

    /// @note  slots must end at or below dimension 4096 (SampleSource draws the others from the tail)
    [[nodiscard]] Point point(Pixel pixel, std::uint64_t index) const noexcept {
        return {matrices_, keys_(pixel), index, randomize_};
    }
    /// Vectorised.
    void fill(std::span<const SampleId> samples, SlotRun run, float* out, std::size_t stride) const noexcept;

private:
    PixelKeys keys_;
    const SobolNibble* matrices_;
    Randomize randomize_;
};

}  // namespace koksma
