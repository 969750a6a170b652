#include <koksma/integrators/draws.h>
#include <koksma/integrators/kernel.h>
#include <koksma/sampling/error.h>
#include <koksma/simd/targets.h>

#include "batch/batch_state.h"
#include "kernel_sets.h"

#include <array>
#include <string>

namespace koksma {

namespace {

constexpr std::size_t kBlock = Draws::kCapacity, kBatch = detail::kBatchCapacity;

constexpr std::array<Kernel, 11> kKernels{{
    {"batch/diffuse", detail::kDiffuseEffects, kBatch, detail::make_batch_diffuse},
    {"batch/specular", detail::kSpecularEffects, kBatch, detail::make_batch_specular},
    {"batch/diffuse-textured", detail::kDiffuseTexturedEffects, kBatch, detail::make_batch_diffuse_textured},
    {"batch/still", detail::kStillEffects, kBatch, detail::make_batch_still},
    {"batch/all", detail::kBatchAllEffects, kBatch, detail::make_batch_all},
    {"reference/diffuse", detail::kDiffuseEffects, kBlock, detail::make_reference_diffuse},
    {"reference/specular", detail::kSpecularEffects, kBlock, detail::make_reference_specular},
    {"reference/diffuse-textured", detail::kDiffuseTexturedEffects, kBlock, detail::make_reference_diffuse_textured},
    {"reference/still", detail::kStillEffects, kBlock, detail::make_reference_still},
    {"reference/surfaces", detail::kSurfaceEffects, kBlock, detail::make_reference_surfaces},
    {"reference/all", EffectSet::all(), kBlock, detail::make_reference_all},
}};

/// Without SSE4 (or NEON) there are no packets worth the name.
bool runs_here(const Kernel& k) { return !k.name.starts_with("batch/") || simd::target() != "none"; }

}  // namespace

std::span<const Kernel> kernels() noexcept { return kKernels; }

const Kernel& choose_kernel(EffectSet effects) noexcept {
    for (const Kernel& k : kKernels)
        if (k.effects.contains(effects) && runs_here(k)) return k;
    return kKernels.back();
}

EffectSet largest_effects(EffectSet needed) noexcept {
    const Kernel& chosen = choose_kernel(needed);
    EffectSet largest = chosen.effects;
    for (const Kernel& k : kKernels)
        if (k.name.starts_with("batch/") == chosen.name.starts_with("batch/") && k.effects.contains(largest)) largest = k.effects;
    return largest;
}

const Kernel& find_kernel(std::string_view name, EffectSet needed) {
    std::string known;
    for (const Kernel& k : kKernels) {
        if (k.name == name) {
            if (!runs_here(k)) throw Error("kernel '" + std::string(name) + "' needs SSE4 or better, which this CPU lacks");
            if (k.effects.contains(needed)) return k;
            std::string missing;
            for (const std::string& e : EffectSet(needed.bits & ~k.effects.bits).names()) missing += (missing.empty() ? "" : ", ") + e;
            throw Error("kernel '" + std::string(name) + "' lacks effects that the scene calls for: " + missing);
        }
        known += (known.empty() ? "" : ", ") + std::string(k.name);
    }
    throw Error("unknown kernel '" + std::string(name) + "'; kernels: " + known);
}

}  // namespace koksma
