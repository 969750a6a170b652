#pragma once
// Drawing values for checks.

#include <koksma/conformance/checks.h>

#include <algorithm>
#include <initializer_list>
#include <sstream>

namespace koksma::conformance {

/// `pairs` slots of arity 2, then `singles` slots of arity 1.
inline DimensionLayout slots_2d_1d(std::size_t pairs, std::size_t singles = 0) {
    std::vector<std::uint8_t> arities(pairs, 2);
    arities.resize(pairs + singles, 1);
    return plain_layout(arities);
}

/// Binds a sampler to a film large enough for the pixels that the checks use.
/// @param seed  counted from the subject's first seed
inline std::unique_ptr<SampleSource> bind(const Subject& s, const DimensionLayout& layout, std::uint64_t spp, std::uint64_t seed = 1) {
    return s.factory->bind({.film_width = 2048, .film_height = 2048, .spp = spp, .seed = s.first_seed + seed, .layout = layout});
}

/// The number of samples nearest to `wanted` from below that the sampler keeps its promises at.
inline std::uint64_t good_count(const Subject& s, std::uint64_t wanted) {
    std::uint64_t n = std::min(wanted, s.info().max_samples);
    while (n > 1 && !s.info().good_counts.contains(n)) --n;
    return n;
}

/// Counts to try: good ones, and for sets also others, where their strata cannot be a grid.
inline std::vector<std::uint64_t> counts(const Subject& s, std::initializer_list<std::uint64_t> wanted) {
    std::vector<std::uint64_t> all;
    for (const std::uint64_t n : wanted) all.push_back(good_count(s, n));
    if (s.is_set())
        for (const std::uint64_t n : {3u, 7u, 10u})
            if (n <= s.info().max_samples) all.push_back(n);
    return all;
}

/// Values of all dimensions of a layout for a list of samples.
class Draw {
public:
    Draw(const SampleSource& source, SlotRun run, std::span<const SampleId> ids)
        : count_(ids.size()), dimensions_(dimension_count(run)), values_(count_ * dimensions_, -1.0f) {
        if (count_ > 0) source.fill(ids, run, values_.data(), count_);
    }
    /// Samples [first, first + count) of a pixel.
    Draw(const SampleSource& source, SlotRun run, Pixel pixel, std::uint64_t first, std::size_t count)
        : Draw(source, run, consecutive(pixel, first, count)) {}

    [[nodiscard]] float operator()(std::size_t i, std::size_t d) const noexcept { return values_[d * count_ + i]; }
    [[nodiscard]] std::size_t count() const noexcept { return count_; }
    [[nodiscard]] std::size_t dimensions() const noexcept { return dimensions_; }
    [[nodiscard]] const std::vector<float>& values() const noexcept { return values_; }

    static std::vector<SampleId> consecutive(Pixel pixel, std::uint64_t first, std::size_t count) {
        std::vector<SampleId> ids(count);
        for (std::size_t i = 0; i < count; ++i) ids[i] = {pixel, first + i};
        return ids;
    }

private:
    std::size_t count_, dimensions_;
    std::vector<float> values_;
};

/// The 24 leading bits of a value, exact in [0, 1).
inline std::uint32_t bits24(float u) noexcept {
    return u >= 0.0f && u < 1.0f ? static_cast<std::uint32_t>(u * 0x1p24f) : 0xffffffu;
}

/// The cell of u among n equal ones, computed in double (exact for n < 2^29). Values outside [0, 1), which `range` reports,
/// count as 0 or as the last cell.
inline std::size_t cell(float u, std::size_t n) noexcept {
    if (!(u >= 0.0f)) return 0;
    return std::min(static_cast<std::size_t>(static_cast<double>(std::min(u, 1.0f)) * static_cast<double>(n)), n - 1);
}

template <class... T>
std::string text(const T&... parts) {
    std::ostringstream s;
    (s << ... << parts);
    return s.str();
}

template <class... T>
Finding failed(const T&... parts) {
    return {.passed = false, .numbers = text(parts...)};
}

inline Finding passed(std::string numbers = {}) { return {.numbers = std::move(numbers)}; }
inline Finding not_applicable(std::string why) { return {.applies = false, .numbers = std::move(why)}; }

}  // namespace koksma::conformance
