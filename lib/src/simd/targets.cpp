#include <koksma/sampling/error.h>
#include <koksma/simd/targets.h>

#include <hwy/targets.h>

#include <cstdint>

namespace koksma::simd {

namespace {

// What each_target.h compiles for, best first.
constexpr std::int64_t kCompiled[] = {HWY_AVX3, HWY_AVX2, HWY_SSE4, HWY_NEON};

/// Of the CPU, whatever use_target() has said.
std::int64_t available() {
    static const std::int64_t all = hwy::SupportedTargets();
    return all;
}

std::int64_t limit = 0;  // 0: none

}  // namespace

std::vector<std::string> targets() {
    std::vector<std::string> names;
    for (const std::int64_t t : kCompiled)
        if ((available() & t) != 0) names.emplace_back(hwy::TargetName(t));
    return names;
}

std::string target() {
    for (const std::int64_t t : kCompiled)
        if ((available() & t) != 0 && (limit == 0 || limit == t)) return hwy::TargetName(t);
    return "none";
}

void use_target(std::string_view name) {
    std::int64_t wanted = 0;
    std::string known;
    for (const std::int64_t t : kCompiled) {
        if ((available() & t) == 0) continue;
        if (name == hwy::TargetName(t)) wanted = t;
        known += (known.empty() ? "" : ", ") + std::string(hwy::TargetName(t));
    }
    if (!name.empty() && wanted == 0) throw Error("unknown instruction set '" + std::string(name) + "'; this CPU has: " + known);
    limit = wanted;
    hwy::SetSupportedTargetsForTest(wanted == 0 ? 0 : wanted | HWY_SCALAR | HWY_EMU128);
    hwy::GetChosenTarget().Update(hwy::SupportedTargets());
}

}  // namespace koksma::simd
