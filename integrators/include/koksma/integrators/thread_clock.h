#pragma once
// CPU time of the calling thread: what rendering costs, whatever else the machine does.

#include <ctime>

namespace koksma {

/// Seconds of CPU time that this thread has used.
[[nodiscard]] inline double thread_seconds() noexcept {
    timespec t{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
    return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

}  // namespace koksma
