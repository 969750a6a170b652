#pragma once
// Deliberately broken samplers: each a small function of what a value may depend on, wrong in one way.
// A family is a healthy sampler, what it promises, and its mutants. That the healthy one passes every check shows that its
// mutants are rejected for their fault and not for the way they are written.

#include <koksma/conformance/subject.h>

#include <string>
#include <vector>

namespace koksma::mutation {

/// All that a value may depend on.
struct At {
    std::uint64_t seed = 0, index = 0;
    Pixel pixel{};
    std::uint32_t dimension = 0;
    std::uint32_t slot = 0;  ///< first dimension of the slot that `dimension` is drawn in
    std::uint8_t arity = 1;  ///< of the slot
    std::uint64_t spp = 1;   ///< of the plan
};

using Value = float (*)(At) noexcept;

struct Mutant {
    std::string name;
    std::string fault;  ///< what is wrong, or where it was seen
    Value value;
};

struct Family {
    std::string name;
    SamplerInfo info{};
    conformance::Promises promises{};
    bool randomized = true;
    Value healthy;
    std::vector<Mutant> mutants{};
};

/// What the checks are given.
[[nodiscard]] conformance::Subject subject(const Family& family, const std::string& name, Value value);

[[nodiscard]] Family sobol_family();        ///< joint, Owen-scrambled
[[nodiscard]] Family plain_sobol_family();  ///< not randomized
[[nodiscard]] Family padded_family();       ///< pairs of Sobol', shuffled and scrambled
[[nodiscard]] Family halton_family();       ///< Owen-scrambled
[[nodiscard]] Family plain_halton_family();
[[nodiscard]] Family rotated_family();      ///< Sobol' under Cranley-Patterson rotation
[[nodiscard]] Family jitter_family();
[[nodiscard]] Family lhs_family();
[[nodiscard]] Family random_family();
[[nodiscard]] std::vector<Family> all_families();

}  // namespace koksma::mutation
