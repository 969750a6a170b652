#pragma once
// What ran, and on what: provenance for images, rows and reports.

#include <string>

namespace koksma {

struct Machine {
    std::string cpu;       ///< model name
    int cores = 1;         ///< that this process may use
    std::string isa;       ///< widest vector instruction set
    std::string compiler;
};
[[nodiscard]] Machine machine();

/// Short commit of the source tree, with "+" if it had changes; "unknown" outside a repository.
[[nodiscard]] std::string commit();
/// "0.1.0"
[[nodiscard]] std::string version();
/// One line for --version.
[[nodiscard]] std::string version_text();

}  // namespace koksma
