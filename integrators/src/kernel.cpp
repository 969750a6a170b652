#include <koksma/sampling/error.h>

#include "kernel_body.h"

#include <array>

namespace koksma {

namespace {

constexpr std::array<Kernel, 4> kKernels{{
    {"reference/diffuse", detail::kDiffuseEffects, detail::trace_block<detail::kDiffuseEffects>},
    {"reference/specular", detail::kSpecularEffects, detail::trace_block<detail::kSpecularEffects>},
    {"reference/diffuse-textured", detail::kDiffuseTexturedEffects, detail::trace_block<detail::kDiffuseTexturedEffects>},
    {"reference/all", EffectSet::all(), detail::trace_block<EffectSet::all()>},
}};

}  // namespace

std::span<const Kernel> kernels() noexcept { return kKernels; }

const Kernel& choose_kernel(EffectSet effects) noexcept {
    for (const Kernel& k : kKernels)
        if (k.effects.contains(effects)) return k;
    return kKernels.back();
}

const Kernel& find_kernel(std::string_view name, EffectSet needed) {
    std::string known;
    for (const Kernel& k : kKernels) {
        if (k.name == name) {
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
