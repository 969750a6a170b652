#pragma once
// The Python that draws: reports and cards.

#include <string>
#include <vector>

namespace koksma {

/// The Python that has the packages of the distribution, unless the user names another in KOKSMA_PYTHON.
[[nodiscard]] std::string python_program();

/// Runs it with an argument list (no shell), after standard output is flushed.
/// @return its exit code, 127 if it could not be started
[[nodiscard]] int run_python(const std::vector<std::string>& arguments, const std::string& python_path);

}  // namespace koksma
