#pragma once
// Independent uniform numbers for tests that need no sampler.

#include <koksma/math/vec3.h>
#include <koksma/sampling/bits.h>

namespace koksma::testing {

struct Uniform {
    Key key;
    std::uint32_t counter = 0;
    explicit Uniform(std::uint32_t seed) : key{seed, 0x5eedu} {}
    float operator()() noexcept { return unit_float(keyed_hash(key, counter++)); }
    Vec2f pair() noexcept {
        const float x = (*this)();
        return {x, (*this)()};
    }
};

}  // namespace koksma::testing
