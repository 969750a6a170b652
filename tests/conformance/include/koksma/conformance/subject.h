#pragma once
// What is checked: one sampler with one choice of its enumerated options, and what it promises.

#include <koksma/sampling/registry.h>

#include <memory>
#include <string>
#include <vector>

namespace koksma::conformance {

/// What a sampler promises beyond uniform, independent dimensions. Derived from its SamplerInfo; `named_promises` adds what
/// that cannot say.
struct Promises {
    /// 0: none. b >= 2: the first b^m samples of a pixel put one value of every dimension into each interval of length b^-m.
    std::uint32_t strata_base = 0;
    bool strata_prime_bases = false;   ///< the same, dimension d in the d-th prime base (Halton)
    bool strata_of_set = false;        ///< the spp samples of a plan put one value of a 1-D slot into each 1/spp
    bool cells_of_set = false;         ///< for square spp, one value of a 2-D slot into each cell of a square grid
    bool net_of_first_pair = false;    ///< dimensions 0 and 1 are a (0,2)-sequence in base 2: every aligned block of 2^m is a (0,m,2)-net
    bool sobol_projections = false;    ///< the pairs of dimensions have the quality parameters of Joe and Kuo's matrices
    bool nested_scrambling = false;    ///< in those bases, as by Owen 1995: digits below the first differing one are independent
    bool multiples_of_2_24 = false;    ///< all values are multiples of 2^-24: converted from integers without rounding
    bool independent_samples = false;  ///< samples of one pixel are independent of each other (the lag check applies)
};

/// A sampler with its options fixed.
struct Subject {
    std::shared_ptr<const SamplerFactory> factory{};
    Promises promises{};
    bool randomized = true;          ///< different seeds are independent replicates
    bool pixels_shared = false;      ///< pixels=shared: all pixels have the same values
    bool pixels_independent = true;  ///< different pixels are independent: scope pixel, and no option says otherwise

    [[nodiscard]] const SamplerInfo& info() const noexcept { return factory->info(); }
    [[nodiscard]] const std::string& name() const noexcept { return factory->name(); }
    [[nodiscard]] bool is_set() const noexcept { return info().kind == SamplerKind::set; }
};

/// The subjects of one sampler: all combinations of the options that list their values.
[[nodiscard]] std::vector<Subject> subjects(const Registry& registry, const SamplerInfo& info);

/// The subjects of all samplers of a registry.
[[nodiscard]] std::vector<Subject> subjects(const Registry& registry);

}  // namespace koksma::conformance
