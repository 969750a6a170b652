#pragma once
// Which instruction set vectorised code runs with. Chosen at run time: one binary for SSE4 to AVX-512.

#include <string>
#include <string_view>
#include <vector>

namespace koksma::simd {

/// Instruction sets that this build has and this CPU can run, best first, by Highway's names ("AVX3" is AVX-512).
[[nodiscard]] std::vector<std::string> targets();

/// The one in use.
[[nodiscard]] std::string target();

/// Limits the whole process to one of targets(), for tests and diagnosis; an empty name gives the choice back. Not while
/// other threads render. Results do not depend on it.
/// @throws Error naming what there is
void use_target(std::string_view name);

}  // namespace koksma::simd
