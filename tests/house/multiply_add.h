#pragma once

namespace koksma::house {

/// a * b + c as the compiler makes it, in a file that may use fused multiply-add instructions where the CPU has them.
[[nodiscard]] float multiply_add(float a, float b, float c) noexcept;
[[nodiscard]] double multiply_add(double a, double b, double c) noexcept;

}  // namespace koksma::house
