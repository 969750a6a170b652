#include "multiply_add.h"

#ifdef __FAST_MATH__
#error "fast-math is on: sums may be reassociated and NaN ignored"
#endif
#if defined(__FINITE_MATH_ONLY__) && __FINITE_MATH_ONLY__
#error "-ffinite-math-only is on: invalid samples could not be found"
#endif

namespace koksma::house {

float multiply_add(float a, float b, float c) noexcept { return a * b + c; }
double multiply_add(double a, double b, double c) noexcept { return a * b + c; }

}  // namespace koksma::house
