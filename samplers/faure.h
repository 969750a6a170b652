#pragma once
// faure: the (0, b)-sequence in prime base b = 3, 5, 7, 11 or 13, for sets of up to b dimensions, padded beyond.
// Source: Faure 1982, "Discrepance de suites associees a un systeme de numeration (en dimension s)", Acta Arith. 41;
// Owen 1995, "Randomly permuted (t,m,s)-nets and (t,s)-sequences" (digits, owen).

#include "joint_sets.h"
#include "pixel_keys.h"

#include <array>
#include <vector>

namespace koksma {

/// What is needed of a base, computed once.
struct FaureBase {
    /// 16 digits of a point, most significant first, eight bits each: sums over all digits of an index do not overflow.
    using Digits = std::array<std::uint64_t, 2>;

    std::uint32_t base = 5;
    std::uint32_t digits = 0;    ///< how many digits a point has: the fewest with base^digits >= 2^24
    std::uint32_t columns = 0;   ///< how many digits a 64-bit index has at most
    std::uint32_t kept = 0;      ///< digits whose strata a float is kept in: the most with 8 floats or more in each
    std::uint64_t cells = 1;     ///< base^kept
    double scale = 0;            ///< 2^24 / cells
    double rest_scale = 1;       ///< base^(kept - digits)
    std::uint32_t reciprocal = 0;  ///< ceil(2^16 / base)
    /// [(dimension * columns + place of the digit in the index) * base + value of the digit]
    std::vector<Digits> table{};

    /// @throws Error if there is no such base
    explicit FaureBase(std::uint32_t b);

    /// n mod base for n < 256.
    [[nodiscard]] std::uint32_t remainder(std::uint32_t n) const noexcept { return n - ((n * reciprocal) >> 16) * base; }
};

class FaureSampler {
public:
    enum class Randomize : std::uint8_t { none, digits, owen };

    struct Tables {
        FaureBase base;
        /// @throws Error if the option base is not one of the primes
        explicit Tables(const SamplerOptions& options);
        /// Good counts are powers of the base, and sets have as many dimensions.
        void describe(SamplerInfo& info) const;
    };

    class Point {
    public:
        Point(const FaureSampler& sampler, Key pixel, std::uint64_t index) noexcept
            : sampler_(&sampler), orders_(join_key(derive_key(pixel, 0x6f72646572ull))), values_(join_key(derive_key(pixel, 0x6661757265ull))),
              index_(index) {}

        [[nodiscard]] float get_1d(const Slot& slot) const noexcept {
            float u[1];
            values(slot.dimension, u);
            return u[0];
        }
        [[nodiscard]] glm::vec2 get_2d(const Slot& slot) const noexcept {
            float u[2];
            values(slot.dimension, u);
            return {u[0], u[1]};
        }

    private:
        template <std::size_t arity>
        void values(std::uint32_t dimension, float (&out)[arity]) const noexcept;
        [[nodiscard]] float value(const FaureBase::Digits& sum, std::uint32_t dimension) const noexcept;

        const FaureSampler* sampler_;
        std::uint64_t orders_, values_, index_;
    };

    [[nodiscard]] static SamplerInfo info();
    FaureSampler(const SamplerOptions& options, const SamplingPlan& plan, const Tables& tables);

    /// @note  draws the slots of the plan's layout only
    [[nodiscard]] Point point(Pixel pixel, std::uint64_t index) const noexcept {
        return {*this, randomize_ == Randomize::none ? Key{} : keys_(pixel), index};
    }

private:
    PixelKeys keys_;
    const FaureBase* base_;
    std::vector<JointPlace> places_;
    Randomize randomize_;
};

}  // namespace koksma
