#pragma once
// pmj02: progressive multi-jittered (0,2) samples with best candidates, from eight tables of 4096 points.
// Source: Christensen, Kensler and Kilpatrick 2018, "Progressive multi-jittered sample sequences", Computer Graphics Forum
// 37(4); the tables are data/pmj02_best.inc, made by tools/make_pmj02.cpp.

#include "pixel_keys.h"

#include <koksma/sampling/owen_hash.h>

#include <bit>

namespace koksma {

inline constexpr std::uint32_t kPmjTables = 8, kPmjPoints = 4096;
inline constexpr std::uint64_t kPmjOrders = ~std::uint64_t{0};  ///< a counter that no sample index takes

/// In units of 2^-16: x of point i of table t is [2 * (t * kPmjPoints + i)], y follows it.
[[nodiscard]] const std::uint16_t* pmj_tables() noexcept;

class Pmj02Sampler {
public:
    enum class Randomize : std::uint8_t { none, shift, digital_shift, owen };

    class Point {
    public:
        Point(const std::uint16_t* tables, Key pixel, std::uint64_t index, Randomize randomize) noexcept
            : tables_(tables), values_(pixel), orders_(derive_key(pixel, kPmjOrders)), fine_(derive_key(pixel, index)),
              index_(static_cast<std::uint32_t>(index % kPmjPoints)), randomize_(randomize) {}

        [[nodiscard]] float get_1d(const Slot& slot) const noexcept { return value(*entry(slot.dimension), slot.dimension); }
        [[nodiscard]] glm::vec2 get_2d(const Slot& slot) const noexcept {
            const std::uint16_t* p = entry(slot.dimension);
            return {value(p[0], slot.dimension), value(p[1], slot.dimension + 1)};
        }

    private:
        [[nodiscard]] const std::uint16_t* entry(std::uint32_t dimension) const noexcept;
        [[nodiscard]] float value(std::uint32_t leading, std::uint32_t dimension) const noexcept;

        const std::uint16_t* tables_;
        Key values_, orders_, fine_;
        std::uint32_t index_;
        Randomize randomize_;
    };

    [[nodiscard]] static SamplerInfo info();
    Pmj02Sampler(const SamplerOptions& options, const SamplingPlan& plan);

    /// An index of 4096 or above, which no plan has, takes the entry of index mod 4096 with finer digits of its own.
    [[nodiscard]] Point point(Pixel pixel, std::uint64_t index) const noexcept {
        return {pmj_tables(), randomize_ == Randomize::none ? Key{} : keys_(pixel), index, randomize_};
    }
    /// Vectorised.
    void fill(std::span<const SampleId> samples, SlotRun run, float* out, std::size_t stride) const noexcept;

private:
    PixelKeys keys_;
    Randomize randomize_;
};

}  // namespace koksma
