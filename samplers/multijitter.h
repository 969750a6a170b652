#pragma once
// multijitter: multi-jittered sets, correlated or not. Each 2-D slot has one point in each cell of a grid and, at the same time, one
// value of either coordinate in each of spp strata; for any spp.
// Source: Chiu, Shirley and Wang 1994, "Multi-jittered sampling", Graphics Gems IV; Kensler 2013, "Correlated Multi-Jittered
// Sampling" (Pixar TM 13-01). The columns of counts that are no full grid are ours: Kensler leaves strata of x empty there.

#include "permutation.h"
#include "pixel_keys.h"
#include "stratum.h"

#include <algorithm>

namespace koksma {

/// The columns and rows of a 2-D slot. All rows are full but the last, which has `last` points; so `last` columns have a
/// point in every row, and the others one less.
struct MultiJitterGrid {
    std::uint32_t columns = 1, rows = 1, last = 1;

    /// The full grid nearest to a square, unless its long side is more than twice its short side (primes above 2; 10, 14,
    /// 21, 22, ...): then as many columns as the integer nearest to sqrt(spp).
    [[nodiscard]] static constexpr MultiJitterGrid of(std::uint32_t spp) noexcept {
        std::uint32_t root = 1;
        while (std::uint64_t{root + 1} * (root + 1) <= spp) ++root;
        std::uint32_t divisor = root;
        while (spp % divisor != 0) --divisor;
        if (spp / divisor <= 2 * divisor) return {spp / divisor, divisor, spp / divisor};
        root += spp > root * (root + 1);
        const std::uint32_t rows = (spp + root - 1) / root;
        return {root, rows, spp - (rows - 1) * root};
    }
    [[nodiscard]] constexpr bool full() const noexcept { return last == columns; }

    /// The column of the k-th point of the last row: those columns are spread evenly.
    [[nodiscard]] constexpr std::uint32_t column_of_last(std::uint32_t k) const noexcept {
        return static_cast<std::uint32_t>(std::uint64_t{k} * columns / last);
    }
    /// How many columns before this one have a point in the last row: the k with k * columns / last < column.
    [[nodiscard]] constexpr std::uint32_t longer_before(std::uint32_t column) const noexcept {
        return static_cast<std::uint32_t>((std::uint64_t{column} * last + columns - 1) / columns);
    }
};

class MultiJitterSampler {
    static constexpr std::uint64_t kSlotKeys = ~std::uint64_t{0};  ///< a counter that no sample index takes

public:
    class Point {
    public:
        Point(const MultiJitterSampler& sampler, Key pixel, std::uint64_t index) noexcept
            : sampler_(&sampler), slots_(derive_key(pixel, kSlotKeys)), jitter_(derive_key(pixel, index)),
              index_(static_cast<std::uint32_t>(index < sampler.count_ ? index : index % sampler.count_)) {}

        [[nodiscard]] float get_1d(const Slot& slot) const noexcept { return place(shuffled(slot.dimension), slot.dimension); }

        [[nodiscard]] glm::vec2 get_2d(const Slot& slot) const noexcept {
            const std::uint32_t d = slot.dimension, s = shuffled(d);
            const MultiJitterGrid& grid = sampler_->grid_;
            const std::uint32_t row = s / grid.columns, k = s % grid.columns;
            const bool full_row = row + 1 < grid.rows || grid.full();
            const std::uint32_t column = full_row ? permute(k, grid.columns, order_key(d, 1, row))
                                                  : grid.column_of_last(permute(k, grid.last, slot_key(d, 2)));
            const std::uint32_t first_long = grid.longer_before(column), is_long = grid.longer_before(column + 1) - first_long;
            const std::uint32_t place_in_column = permute(row, grid.rows - 1 + is_long, order_key(d, 3 + is_long, column));
            std::uint32_t x = column * (grid.rows - 1) + first_long + place_in_column;
            // Columns of two lengths do not lie alike everywhere: a rotation makes each stratum of x equally likely for each y.
            if (!grid.full()) x = static_cast<std::uint32_t>((x + sampler_->rotation(slot_key(d, 5))) % sampler_->count_);
            return {place(x, d), place(s, d + 1)};
        }

    private:
        [[nodiscard]] Key slot_key(std::uint32_t d, std::uint32_t purpose) const noexcept {
            return derive_key(slots_, (std::uint64_t{purpose} << 32) | d);
        }
        /// The order within a row or a column. Correlated: the same for all rows, and for all columns of equal length.
        [[nodiscard]] Key order_key(std::uint32_t d, std::uint32_t purpose, std::uint32_t line) const noexcept {
            const Key key = slot_key(d, purpose);
            return sampler_->correlated_ ? key : derive_key(key, line);
        }
        [[nodiscard]] std::uint32_t shuffled(std::uint32_t d) const noexcept {
            return permute(index_, static_cast<std::uint32_t>(sampler_->count_), slot_key(d, 0));
        }
        [[nodiscard]] float place(std::uint32_t stratum, std::uint32_t d) const noexcept {
            return stratum_float(stratum, sampler_->count_, sampler_->scale_, keyed_hash(jitter_, d) * 0x1p-32);
        }

        const MultiJitterSampler* sampler_;
        Key slots_, jitter_;
        std::uint32_t index_;
    };

    [[nodiscard]] static SamplerInfo info() {
        return {.name = "multijitter",
                .title = "Correlated multi-jittered",
                .paper = "Kensler 2013, Correlated Multi-Jittered Sampling",
                .options = {{.name = "order",
                             .default_value = "correlated",
                             .values = {"correlated", "independent"},
                             .help = "one order for all rows and one for all columns (Kensler 2013), or one for each (Chiu et al. 1994)"},
                            pixels_option()},
                .kind = SamplerKind::set,
                .joint = 2,
                .remark = "squares have square cells; strata of either coordinate are complete at any count",
                .max_samples = kMaxStrata};
    }

    MultiJitterSampler(const SamplerOptions& options, const SamplingPlan& plan)
        : keys_(options, plan, 0x6d756c74696aull), count_(std::clamp<std::uint64_t>(plan.spp, 1, kMaxStrata)),
          grid_(MultiJitterGrid::of(static_cast<std::uint32_t>(count_))), scale_(0x1p24 / static_cast<double>(count_)),
          correlated_(options["order"] == "correlated") {}

    /// An index of spp or above falls into the strata of index mod spp, with a jitter of its own.
    [[nodiscard]] Point point(Pixel pixel, std::uint64_t index) const noexcept { return {*this, keys_(pixel), index}; }
    /// Vectorised.
    void fill(std::span<const SampleId> samples, SlotRun run, float* out, std::size_t stride) const noexcept;

private:
    [[nodiscard]] std::uint64_t rotation(Key key) const noexcept { return (keyed_hash(key, 0) * count_) >> 32; }

    PixelKeys keys_;
    std::uint64_t count_;
    MultiJitterGrid grid_;
    double scale_;
    bool correlated_;
};

}  // namespace koksma
