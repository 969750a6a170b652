#pragma once
// Russian roulette as the lecture writes it: one number decides, and what is left of it is used again.

#include <koksma/sampling/bits.h>

namespace koksma {

/// Whether a game was won, and the number stretched back to [0, 1).
struct RescaledNumber {
    bool survives;
    float u;
};

/// u < survival wins, and u / survival is uniform again.
/// @param u         [0, 1)
/// @param survival  (0, 1]
[[nodiscard]] constexpr RescaledNumber rescaled(float u, float survival) noexcept {
    if (!(u < survival)) return {false, u};
    const float stretched = u / survival;
    return {true, stretched < kOneMinusUlp ? stretched : kOneMinusUlp};
}

/// I_roulette = f(x / P) / P if x < P, else 0: for x uniform in [0, 1) an unbiased estimate of the integral of f.
/// Its variance for one x is (integral of f^2) / P - (integral of f)^2.
template <class F>
[[nodiscard]] double i_roulette(const F& f, float x, float survival) {
    const RescaledNumber game = rescaled(x, survival);
    return game.survives ? f(game.u) / static_cast<double>(survival) : 0.0;
}

/// The same with a number of its own for the decision. The same variance for independent numbers, not for a sequence.
template <class F>
[[nodiscard]] double i_roulette(const F& f, float x, float decision, float survival) {
    return decision < survival ? f(x) / static_cast<double>(survival) : 0.0;
}

}  // namespace koksma
