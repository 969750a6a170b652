#pragma once
// Independent uniform numbers for tests that need no sampler.

#include <koksma/sampling/bits.h>

#include <glm/vec2.hpp>

namespace koksma::testing {

struct Uniform {
    Key key;
    std::uint32_t counter = 0;
    explicit Uniform(std::uint32_t seed) : key{seed, 0x5eedu} {}
    float operator()() noexcept { return unit_float(keyed_hash(key, counter++)); }
    glm::vec2 pair() noexcept {
        const float x = (*this)();
        return {x, (*this)()};
    }
};

}  // namespace koksma::testing
