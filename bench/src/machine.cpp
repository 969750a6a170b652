#include "machine.h"

#include <koksma/scene/accelerator.h>

#include <fmt/format.h>
#include <koksma_version.h>

#include <fstream>
#include <thread>

#if defined(__linux__)
#include <sched.h>
#endif

namespace koksma {

namespace {

std::string cpu_model() {
    std::ifstream in("/proc/cpuinfo");
    for (std::string line; std::getline(in, line);)
        if (line.starts_with("model name")) return line.substr(line.find(':') + 2);
    return "unknown CPU";
}

std::string widest_isa() {
#if defined(__x86_64__)
    if (__builtin_cpu_supports("avx512f")) return "avx512";
    if (__builtin_cpu_supports("avx2")) return "avx2";
    if (__builtin_cpu_supports("avx")) return "avx";
    return "sse";
#elif defined(__aarch64__)
    return "neon";
#else
    return "unknown";
#endif
}

int usable_cores() {
#if defined(__linux__)
    cpu_set_t set;
    if (sched_getaffinity(0, sizeof set, &set) == 0) return CPU_COUNT(&set);
#endif
    return static_cast<int>(std::thread::hardware_concurrency());
}

}  // namespace

Machine machine() {
#if defined(__clang__)
    const std::string compiler = fmt::format("clang {}.{}", __clang_major__, __clang_minor__);
#else
    const std::string compiler = fmt::format("gcc {}.{}", __GNUC__, __GNUC_MINOR__);
#endif
    return {cpu_model(), usable_cores(), widest_isa(), compiler};
}

std::string commit() { return KOKSMA_COMMIT; }
std::string version() { return KOKSMA_VERSION; }
std::string version_text() { return fmt::format("koksma {} ({}), {}", version(), commit(), Accelerator::version()); }

}  // namespace koksma
