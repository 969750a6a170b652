#pragma once
// A file in memory that holds one input at a time.

#include <koksma/sampling/error.h>

#include <fcntl.h>
#include <sys/mman.h>
#include <unistd.h>

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <string>

namespace koksma::fuzz {

/// Rewritten for every input. @return  its path
inline std::filesystem::path file_of(const std::uint8_t* data, std::size_t size) {
    static const int file = memfd_create("koksma-fuzz", 0);
    if (file < 0 || ftruncate(file, 0) != 0 || lseek(file, 0, SEEK_SET) != 0) std::abort();
    for (std::size_t done = 0; done < size;) {
        const auto n = write(file, data + done, size - done);
        if (n <= 0) std::abort();
        done += static_cast<std::size_t>(n);
    }
    return "/proc/self/fd/" + std::to_string(file);
}

/// Whatever the input, a loader returns or throws Error. Anything else ends the fuzzer.
template <class F>
void expect_error_at_most(F&& load) {
    try {
        load();
    } catch (const Error&) {
    }
}

}  // namespace koksma::fuzz
