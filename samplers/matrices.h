#pragma once
// matrices: a digital sequence from generator matrices in a file, in any prime base.
// Source: Niederreiter 1987, "Point sets and sequences with small discrepancy" (digital sequences); Owen 1995, "Randomly
// permuted (t,m,s)-nets and (t,s)-sequences" (digits, owen).

#include "generator_matrices.h"
#include "halton.h"
#include "padding.h"
#include "pixel_keys.h"
#include "sobol.h"

namespace koksma {

class MatricesSampler {
public:
    enum class Randomize : std::uint8_t { none, digits, owen };

    /// The matrices in the form that evaluation wants.
    class Tables {
    public:
        /// @throws Error naming file and line
        explicit Tables(const SamplerOptions& options);
        [[nodiscard]] const std::string& checksum() const noexcept { return checksum_; }
        void describe(SamplerInfo& info) const;

    private:
        friend class MatricesSampler;
        void make_binary(const GeneratorMatrices& m);
        void make_digits(const GeneratorMatrices& m);

        std::string file_, checksum_;
        std::string pad_;
        std::uint32_t dimensions_ = 0, columns_ = 0, rows_ = 0;
        std::uint64_t count_ = 0;
        bool stratified_ = true;
        const HaltonBase* base_ = nullptr;
        std::vector<SobolNibble> own_;               ///< base 2
        const SobolNibble* nibbles_ = nullptr;       ///< base 2: own_, or the Sobol' matrices
        std::vector<std::uint16_t> digits_;          ///< other bases: [(d * columns + c) * base_->digits + r]
    };

    class Point {
    public:
        Point(const MatricesSampler& sampler, Key pixel, std::uint64_t index) noexcept
            : sampler_(&sampler), orders_(derive_key(pixel, 0x6f72646572ull)), values_(pixel), digit_key_(join_key(derive_key(pixel, 0x646967697473ull))),
              index_(index) {}

        [[nodiscard]] float get_1d(const Slot& slot) const noexcept {
            const JointPlace place = sampler_->places_[slot.dimension];
            return value(ordered(place.set), place.within, slot.dimension);
        }
        [[nodiscard]] glm::vec2 get_2d(const Slot& slot) const noexcept {
            const JointPlace place = sampler_->places_[slot.dimension];
            const std::uint64_t i = ordered(place.set);
            return {value(i, place.within, slot.dimension), value(i, place.within + 1, slot.dimension + 1)};
        }

    private:
        [[nodiscard]] std::uint64_t ordered(std::uint32_t set) const noexcept;
        [[nodiscard]] float value(std::uint64_t index, std::uint32_t row, std::uint32_t dimension) const noexcept;
        [[nodiscard]] float value_of_digits(std::uint64_t index, std::uint32_t row, std::uint32_t dimension) const noexcept;
        const MatricesSampler* sampler_;
        Key orders_, values_;
        std::uint64_t digit_key_, index_;
    };

    [[nodiscard]] static SamplerInfo info();
    MatricesSampler(const SamplerOptions& options, const SamplingPlan& plan, const Tables& tables);

    /// @note  draws the slots of the plan's layout only
    [[nodiscard]] Point point(Pixel pixel, std::uint64_t index) const noexcept {
        return {*this, randomize_ == Randomize::none ? Key{} : keys_(pixel), index};
    }

private:
    PixelKeys keys_;
    const Tables* tables_;
    std::vector<JointPlace> places_;
    Randomize randomize_;
};

}  // namespace koksma
