#pragma once
// bluenoise: padded Owen-scrambled Sobol' pairs whose points in each pixel are shifted digitally by two keys of a tile. The
// keys are chosen so that the errors of neighbouring pixels cancel.
// Source: Heitz, Belcour, Ostromoukhov, Coeurjolly and Iehl 2019, "A low-discrepancy sampler that distributes Monte Carlo
// errors as a blue noise in screen space" (ACM SIGGRAPH Talks), for tiles of keys found by simulated annealing. Ours: the
// scramble of the seed is applied after the keys, so that every seed is a replicate and all of them keep the arrangement; and
// no ranking keys: the sequence is linear, sobol(i ^ r) = sobol(i) ^ sobol(r), so a ranking key is a scrambling key too.

#include "index_shuffle.h"
#include "sobol_pair.h"

#include <koksma/sampling/sampler.h>

#include <vector>

namespace koksma {

/// The keys of a tile of pixels. Made by samplers/tools/make_bluenoise.cpp.
struct BlueNoiseTile {
    std::uint32_t width = 0, height = 0;  ///< powers of two
    std::uint32_t layers = 0;             ///< how many pairs of dimensions have keys of their own
    std::uint32_t digits = 0;             ///< of each key, at most 16
    std::uint32_t samples = 0;            ///< the largest count that the keys were chosen for; 1, 2, 4, .. were too
    std::vector<std::uint32_t> keys{};    ///< [(layer * height + y) * width + x]: bit j flips binary digit j + 1 of the first
                                          ///< dimension, bit 16 + j of the second

    /// @param text  numbers and // comments: version 1, width, height, layers, digits, samples, then the keys
    /// @throws Error with file and line
    [[nodiscard]] static BlueNoiseTile parse(std::string_view text, const std::string& file);
    /// The tile that is part of the program.
    [[nodiscard]] static BlueNoiseTile built_in();
};

class BlueNoiseSampler {
public:
    class Tables {
    public:
        explicit Tables(const SamplerOptions& options);
        [[nodiscard]] const BlueNoiseTile& tile() const noexcept { return tile_; }
        [[nodiscard]] const std::string& checksum() const noexcept { return checksum_; }
        void describe(SamplerInfo& info) const;

    private:
        std::string file_, checksum_;
        BlueNoiseTile tile_;
    };

    class Point {
    public:
        Point(const BlueNoiseSampler& sampler, Pixel pixel, std::uint64_t index) noexcept
            : sampler_(&sampler), pixel_(pixel), rest_(pixel_key(sampler.rest_seed_, pixel)), index_(index) {}

        [[nodiscard]] float get_1d(const Slot& slot) const noexcept {
            return value(shuffled_index(index_, sampler_->orders_, slot.dimension), key(slot) & 0xffffu, slot.dimension);
        }
        [[nodiscard]] glm::vec2 get_2d(const Slot& slot) const noexcept {
            const std::uint64_t i = shuffled_index(index_, sampler_->orders_, slot.dimension);
            const std::uint32_t k = key(slot);
            return {value(i, k & 0xffffu, slot.dimension), value(pascal_rev(i), k >> 16, slot.dimension + 1)};
        }

    private:
        [[nodiscard]] std::uint32_t key(const Slot& slot) const noexcept {
            // Slots past the last layer take a layer again, moved: their order and scramble are their own all the same.
            const BlueNoiseTile& t = *sampler_->tile_;
            const std::uint32_t move = keyed_hash(sampler_->moves_, slot.dimension);
            const std::uint32_t x = (static_cast<std::uint32_t>(pixel_.x) + (move & 0xffffu)) & (t.width - 1);
            const std::uint32_t y = (static_cast<std::uint32_t>(pixel_.y) + (move >> 16)) & (t.height - 1);
            const std::uint32_t layer = t.layers == 1 ? 0 : slot.dimension % t.layers;
            return t.keys[(std::size_t{layer} * t.height + y) * t.width + x];
        }
        [[nodiscard]] float value(std::uint64_t x_rev, std::uint32_t key, std::uint32_t dimension) const noexcept {
            // Digits below those of the key are the pixel's own: pixels a tile apart are not equal.
            const auto digits = static_cast<std::uint32_t>(x_rev) ^ key ^ (keyed_hash(rest_, dimension) << sampler_->tile_->digits);
            return unit_float(reverse_bits(owen_hash_rev(digits, keyed_hash(sampler_->values_, dimension))));
        }
        const BlueNoiseSampler* sampler_;
        Pixel pixel_;
        Key rest_;
        std::uint64_t index_;
    };

    [[nodiscard]] static SamplerInfo info();
    BlueNoiseSampler(const SamplerOptions& options, const SamplingPlan& plan, const Tables& tables);

    [[nodiscard]] Point point(Pixel pixel, std::uint64_t index) const noexcept { return {*this, pixel, index}; }

private:
    const BlueNoiseTile* tile_;
    std::uint64_t rest_seed_;
    Key orders_, values_, moves_;
};

}  // namespace koksma
