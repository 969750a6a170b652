#pragma once
// What is checked: one sampler with one choice of its enumerated options, and what it promises.

#include <koksma/sampling/registry.h>

#include <array>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace koksma::conformance {

/// A point known as fractions; a denominator of 0 ends it.
struct ReferencePoint {
    std::uint64_t index = 0;
    std::array<std::uint64_t, 8> numerators{}, denominators{};
};

/// Sobol' with the direction numbers new-joe-kuo-6, and Halton in the first primes.
[[nodiscard]] std::span<const ReferencePoint> sobol_reference_points() noexcept;
[[nodiscard]] std::span<const ReferencePoint> halton_reference_points() noexcept;

/// What a sampler promises beyond uniform, independent dimensions. Derived from its SamplerInfo; `named_promises` adds what
/// that cannot say.
struct Promises {
    /// 0: none. b >= 2: the first b^m samples of a pixel put one value of every dimension into each interval of length b^-m.
    std::uint32_t strata_base = 0;
    bool strata_prime_bases = false;   ///< the same, dimension d in the d-th prime base (Halton)
    bool strata_rotated = false;       ///< of those, all points were rotated by one number: equally spaced, to the last place of a float
    bool strata_of_set = false;        ///< the spp samples of a plan put one value of a 1-D slot into each 1/spp
    bool strata_of_pairs = false;      ///< and of each coordinate of a 2-D slot (Latin hypercubes, multi-jitter)
    bool cells_of_set = false;         ///< for square spp, one value of a 2-D slot into each cell of a square grid
    bool net_of_first_pair = false;    ///< dimensions 0 and 1 are a (0,2)-sequence in base 2: every aligned block of 2^m is a (0,m,2)-net
    bool net_of_pairs = false;         ///< the same of every 2-D slot; of a set, for the whole set
    bool prefixes_only = false;        ///< strata_base and net_of_pairs hold for the first samples only, not for every aligned block
    bool sobol_projections = false;    ///< the pairs of dimensions have the quality parameters of Joe and Kuo's matrices
    bool nested_scrambling = false;    ///< in those bases, as by Owen 1995: digits below the first differing one are independent
    bool joint_across_slots = false;   ///< consecutive slots are drawn jointly, in an order of their own: what two of them share depends on it
    bool multiples_of_2_24 = false;    ///< all values are multiples of 2^-24: converted from integers without rounding
    bool values_in_finest_strata = false;  ///< a value lies in its stratum of the finest b^-m that is a float's step or more, so some floats are likelier than others
    bool independent_samples = false;  ///< samples of one pixel are independent of each other (the lag check applies)
    std::span<const ReferencePoint> reference_points{};  ///< of a sequence that is not randomized
};

/// A sampler with its options fixed.
struct Subject {
    std::shared_ptr<const SamplerFactory> factory{};
    Promises promises{};
    bool randomized = true;          ///< different seeds are independent replicates
    bool pixels_shared = false;      ///< pixels=shared: all pixels have the same values
    std::uint64_t first_seed = 0;    ///< the checks count their seeds from here: another one is a fresh trial
    bool pixels_independent = true;  ///< different pixels are independent: scope pixel, and no option says otherwise

    [[nodiscard]] const SamplerInfo& info() const noexcept { return factory->info(); }
    [[nodiscard]] const std::string& name() const noexcept { return factory->name(); }
    [[nodiscard]] bool is_set() const noexcept { return info().kind == SamplerKind::set; }
};

/// True if the sampler cannot be made by its name alone: it reads a file, which only its user can name.
[[nodiscard]] bool needs_a_file(const Registry& registry, const SamplerInfo& info);

/// The subjects of one sampler: all combinations of those options that list their values and that `spec` leaves open.
/// @param spec  "name" or "name:option=value,option=value"
/// @throws Error for an unknown name, option or value, and if the sampler needs more than the options that list their values
[[nodiscard]] std::vector<Subject> subjects(const Registry& registry, std::string_view spec);

/// The subjects of all samplers of a registry, but for those that need a file: their tests name one.
[[nodiscard]] std::vector<Subject> subjects(const Registry& registry);

}  // namespace koksma::conformance
