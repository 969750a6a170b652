#pragma once
// points: points from a file, as they are or with Cranley-Patterson shifts.
// Source: Cranley and Patterson 1976, "Randomization of number theoretic methods for multiple integration"

#include "padding.h"
#include "permutation.h"
#include "pixel_keys.h"

namespace koksma {

/// Point sets as read: K sets of N points in D dimensions; as a screen tile, one set a pixel.
struct PointSets {
    std::size_t sets = 0, points = 0, dimensions = 0;
    std::size_t tile_width = 0, tile_height = 0;  ///< not 0: set y * tile_width + x is that of a pixel
    std::vector<std::uint32_t> values{};          ///< [(set * points + i) * dimensions + d], times 2^32, truncated

    [[nodiscard]] bool is_tile() const noexcept { return tile_width != 0; }
    /// Text: a point a line, sets separated by blank lines, # comments. Or .npy of shape (N, D), (K, N, D) or (H, W, N, D).
    /// @throws Error naming the file, for text the line, and what is wrong
    [[nodiscard]] static PointSets parse(std::string_view bytes, const std::string& file);
    /// 4096 points of the R2 sequence.
    /// Source: Martin Roberts 2018, "The unreasonable effectiveness of quasirandom sequences": the plastic number as generator
    [[nodiscard]] static PointSets built_in();
};

class PointsSampler {
public:
    class Tables {
    public:
        explicit Tables(const SamplerOptions& options);
        [[nodiscard]] const PointSets& sets() const noexcept { return sets_; }
        [[nodiscard]] const std::string& checksum() const noexcept { return checksum_; }
        void describe(SamplerInfo& info) const;

    private:
        std::string file_, checksum_;
        std::string pad_;
        PointSets sets_;
    };

    class Point {
    public:
        Point(const PointsSampler& sampler, const std::uint32_t* set, Key key, std::uint32_t index) noexcept
            : sampler_(&sampler), set_(set), orders_(derive_key(key, 0x6f72646572ull)), shifts_(key), index_(index) {}

        [[nodiscard]] float get_1d(const Slot& slot) const noexcept {
            const JointPlace place = sampler_->places_[slot.dimension];
            return value(row(place.set)[place.within], slot.dimension);
        }
        [[nodiscard]] glm::vec2 get_2d(const Slot& slot) const noexcept {
            // Without padding joint places follow the layout; with it, one-dimensional slots come last in a set.
            const JointPlace place = sampler_->places_[slot.dimension];
            const std::uint32_t* p = row(place.set) + place.within;
            return {value(p[0], slot.dimension), value(p[1], slot.dimension + 1)};
        }

    private:
        /// Sets of dimensions after the first visit the points in an order of their own.
        [[nodiscard]] const std::uint32_t* row(std::uint32_t set) const noexcept {
            const std::uint32_t i = set == 0 ? index_ : permute(index_, sampler_->count_, derive_key(orders_, set));
            return set_ + std::size_t{i} * sampler_->sets_->dimensions;
        }
        [[nodiscard]] float value(std::uint32_t x, std::uint32_t dimension) const noexcept {
            return unit_float(sampler_->shifted_ ? x + keyed_hash(shifts_, dimension) : x);
        }
        const PointsSampler* sampler_;
        const std::uint32_t* set_;
        Key orders_, shifts_;
        std::uint32_t index_;
    };

    [[nodiscard]] static SamplerInfo info();
    PointsSampler(const SamplerOptions& options, const SamplingPlan& plan, const Tables& tables);

    /// An index of spp or above falls on that of index mod spp.
    /// @note  draws the slots of the plan's layout only
    [[nodiscard]] Point point(Pixel pixel, std::uint64_t index) const noexcept {
        const Key key = shifted_ ? (sets_->is_tile() ? film_key_ : keys_(pixel)) : Key{};
        const std::uint32_t* set = sets_->values.data() + set_of(pixel, key) * sets_->points * sets_->dimensions;
        return {*this, set, key, static_cast<std::uint32_t>(index < count_ ? index : index % count_)};
    }

private:
    [[nodiscard]] std::size_t set_of(Pixel pixel, Key key) const noexcept;

    PixelKeys keys_;
    Key film_key_;
    const PointSets* sets_;
    std::vector<JointPlace> places_;
    std::uint32_t count_;
    std::size_t fixed_set_ = 0;
    bool shifted_, any_set_ = false;
};

}  // namespace koksma
