#pragma once
// stratified: jittered strata, the set that Monte Carlo rendering used for decades.
// Source: Cook, Porter and Carpenter 1984, "Distributed ray tracing"; the correlated multi-jittered cells for counts
// without a near-square grid are Kensler 2013, "Correlated Multi-Jittered Sampling" (Pixar TM 13-01).

#include "permutation.h"
#include "pixel_keys.h"
#include "stratum.h"

#include <algorithm>

namespace koksma {

/// The cells of a 2-D slot. columns * rows == spp, except for multi-jittered ones, whose last row is not full.
struct StratifiedGrid {
    std::uint32_t columns = 1, rows = 1;
    bool multi_jittered = false;

    /// The grid nearest to a square with exactly one sample a cell. When its long side is more than twice its short side
    /// (primes above 2; 10, 14, 21, 22, ...), correlated multi-jittered cells, which exist for any count.
    [[nodiscard]] static constexpr StratifiedGrid of(std::uint32_t spp) noexcept {
        std::uint32_t root = 1;
        while (std::uint64_t{root + 1} * (root + 1) <= spp) ++root;
        std::uint32_t divisor = root;
        while (spp % divisor != 0) --divisor;
        const std::uint32_t other = spp / divisor;
        if (other <= 2 * divisor) return {other, divisor, false};
        return {root, (spp + root - 1) / root, true};
    }
};

class StratifiedSampler {
    static constexpr std::uint64_t kSlotKeys = ~std::uint64_t{0};  ///< a counter that no sample index takes

public:
    class Point {
    public:
        Point(const StratifiedSampler& sampler, Key pixel, std::uint64_t index) noexcept
            : sampler_(&sampler), slots_(derive_key(pixel, kSlotKeys)), jitter_(derive_key(pixel, index)),
              index_(static_cast<std::uint32_t>(index % sampler.count_)) {}

        [[nodiscard]] float get_1d(const Slot& slot) const noexcept {
            return sampler_->count_.place(shuffled(slot.dimension), jitter(slot.dimension));
        }
        [[nodiscard]] glm::vec2 get_2d(const Slot& slot) const noexcept {
            const std::uint32_t d = slot.dimension, s = shuffled(d);
            const StratifiedGrid& grid = sampler_->grid_;
            const std::uint32_t column = s % grid.columns, row = s / grid.columns;
            if (!grid.multi_jittered) return {sampler_->columns_.place(column, jitter(d)), sampler_->rows_.place(row, jitter(d + 1))};
            // One sample in each of the 1/spp strata of y, and at most one in each of the columns * rows strata of x.
            const std::uint32_t x = permute(column, grid.columns, slot_key(d, 1)) * grid.rows + permute(row, grid.rows, slot_key(d, 2));
            return {sampler_->columns_.place(x, jitter(d)), sampler_->count_.place(s, jitter(d + 1))};
        }

    private:
        [[nodiscard]] Key slot_key(std::uint32_t d, std::uint32_t purpose) const noexcept {
            return derive_key(slots_, (std::uint64_t{purpose} << 32) | d);
        }
        [[nodiscard]] std::uint32_t shuffled(std::uint32_t d) const noexcept {
            return permute(index_, static_cast<std::uint32_t>(sampler_->count_.n), slot_key(d, 0));
        }
        [[nodiscard]] double jitter(std::uint32_t d) const noexcept { return keyed_hash(jitter_, d) * 0x1p-32; }

        const StratifiedSampler* sampler_;
        Key slots_, jitter_;
        std::uint32_t index_;
    };

    [[nodiscard]] static SamplerInfo info() {
        return {.name = "stratified",
                .title = "Stratified (jittered)",
                .paper = "Cook, Porter and Carpenter 1984, Distributed ray tracing; Kensler 2013, Correlated Multi-Jittered Sampling",
                .options = {pixels_option()},
                .kind = SamplerKind::set,
                .joint = 2,
                .good_counts = {.rule = GoodCounts::Rule::square},
                .max_samples = kMaxStrata};
    }

    StratifiedSampler(const SamplerOptions& options, const SamplingPlan& plan)
        : keys_(options, plan, 0x7374726174696679ull),
          grid_(StratifiedGrid::of(static_cast<std::uint32_t>(clamped(plan.spp)))),
          count_(clamped(plan.spp)),
          columns_(grid_.multi_jittered ? std::uint64_t{grid_.columns} * grid_.rows : grid_.columns),
          rows_(grid_.rows) {}

    /// An index of spp or above falls into the stratum of index mod spp, with a jitter of its own.
    [[nodiscard]] Point point(Pixel pixel, std::uint64_t index) const noexcept { return {*this, keys_(pixel), index}; }
    /// Vectorised.
    void fill(std::span<const SampleId> samples, SlotRun run, float* out, std::size_t stride) const noexcept;

private:
    /// n equal strata of [0, 1).
    struct Strata {
        std::uint64_t n;
        double scale;
        explicit Strata(std::uint64_t count) noexcept : n(count), scale(0x1p24 / static_cast<double>(count)) {}
        [[nodiscard]] float place(std::uint64_t stratum, double jitter) const noexcept {
            return stratum_float(stratum, n, scale, jitter);
        }
        friend std::uint64_t operator%(std::uint64_t index, const Strata& s) noexcept { return index < s.n ? index : index % s.n; }
    };
    [[nodiscard]] static std::uint64_t clamped(std::uint64_t spp) noexcept { return std::clamp<std::uint64_t>(spp, 1, kMaxStrata); }

    PixelKeys keys_;
    StratifiedGrid grid_;
    Strata count_, columns_, rows_;
};

}  // namespace koksma
