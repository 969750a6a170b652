#pragma once
// What a sampler is: a pure function (pixel, sample index, slot, seed) -> [0, 1).

#include <koksma/sampling/bits.h>
#include <koksma/sampling/layout.h>
#include <koksma/sampling/options.h>
#include <koksma/sampling/slot.h>

#include <glm/vec2.hpp>

#include <cmath>
#include <concepts>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

namespace koksma {

/// `sequence`: a value does not depend on how many samples the plan asks for, so prefixes and continuations are valid.
/// `set`: it does (stratified, Latin hypercubes): the set is only complete when all `spp` samples are used.
enum class SamplerKind : std::uint8_t { sequence, set };

/// Over what one sequence is laid out.
enum class SamplerScope : std::uint8_t { pixel, tile, image };

/// The sample counts at which a sampler keeps its promise.
struct GoodCounts {
    enum class Rule : std::uint8_t { any, power, square } rule = Rule::any;
    std::uint32_t base = 0;  ///< of Rule::power
    [[nodiscard]] bool contains(std::uint64_t n) const noexcept {
        if (n == 0) return false;
        if (rule == Rule::power) {
            while (base > 1 && n % base == 0) n /= base;
            return n == 1;
        }
        if (rule == Rule::square) {
            auto r = static_cast<std::uint64_t>(std::sqrt(static_cast<double>(n)));
            while (r * r < n) ++r;
            while (r * r > n) --r;
            return r * r == n;
        }
        return true;
    }
    [[nodiscard]] std::string text() const {
        if (rule == Rule::power) return "powers of " + std::to_string(base);
        return rule == Rule::square ? "squares" : "any";
    }
};

/// What a sampler says of itself. Everything that set-up, tables and documentation need; nothing of it is repeated elsewhere.
struct SamplerInfo {
    std::string name;     ///< as typed after --sampler
    std::string title;    ///< as printed in figures
    std::string paper;    ///< author, year, title
    std::uint32_t version = 1;  ///< bumped by hand when any value changes: result rows key on it
    std::vector<OptionInfo> options{};
    SamplerKind kind = SamplerKind::sequence;
    SamplerScope scope = SamplerScope::pixel;
    std::uint32_t joint = 1;    ///< how many dimensions are drawn jointly: 1, 2, 4; 0 means all
    GoodCounts good_counts{};
    std::string remark{};       ///< what a user must know and the other fields do not say; may be empty
    std::uint32_t max_dimensions = std::numeric_limits<std::uint32_t>::max();  ///< slots beyond it come from the tail
    std::uint64_t max_samples = std::numeric_limits<std::uint64_t>::max();     ///< a plan that asks for more is refused
};

/// What a sampler is bound to. The film is the full one: a crop does not change any value.
struct SamplingPlan {
    std::int32_t film_width = 1, film_height = 1;
    std::uint64_t spp = 1;   ///< samples per pixel of the whole render; only samplers of kind `set` may look at it
    std::uint64_t seed = 0;  ///< every seed is an independent replicate
    DimensionLayout layout;
};

/// A value of one (pixel, sample): draws its slots in any order, any number of times.
template <class P>
concept SamplePoint = requires(const P& p, const Slot& slot) {
    { p.get_1d(slot) } noexcept -> std::same_as<float>;
    { p.get_2d(slot) } noexcept -> std::same_as<glm::vec2>;
};

/// A sampler with tables: `T::Tables(options)` is made once per name with options and shared by all plans.
template <class T>
concept HasTables = requires { typename T::Tables; } && std::constructible_from<typename T::Tables, const SamplerOptions&>;

/// Tables that come from a file may say what the file changes of the sampler's description (limits, counts, scope, remark; not the
/// name or the options): `describe(info)`, once, when they are made. A max_dimensions set there is where the constructor refuses:
/// the tail begins at that of T::info() only.
template <class Tables>
concept HasDescription = requires(const Tables& t, SamplerInfo& info) { t.describe(info); };

/// They may also name their content: `checksum()`, empty without a file, becomes the value of the declared option `checksum`.
template <class Tables>
concept HasChecksum = requires(const Tables& t) {
    { t.checksum() } -> std::convertible_to<std::string>;
};

/// What the author of a sampler writes. `T(options, plan)`, or `T(options, plan, tables)` for one with tables, is cheap and
/// may throw Error (a limit is passed); `point` is called for every sample and may not throw, allocate, or keep state.
template <class T>
concept Sampler = (std::constructible_from<T, const SamplerOptions&, const SamplingPlan&> ||
                   (HasTables<T> && std::constructible_from<T, const SamplerOptions&, const SamplingPlan&, const typename T::Tables&>)) &&
                  requires(const T& t, Pixel pixel, std::uint64_t index) {
                      { T::info() } -> std::same_as<SamplerInfo>;
                      { t.point(pixel, index) } noexcept -> SamplePoint;
                  };

}  // namespace koksma
