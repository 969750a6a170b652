#pragma once
// The one exception type of the library.

#include <stdexcept>
#include <string>

namespace koksma {

/// Thrown at load and set-up, never while rendering. what() is one line: where, what was found, what was expected.
class Error : public std::runtime_error {
public:
    using std::runtime_error::runtime_error;
};

}  // namespace koksma
