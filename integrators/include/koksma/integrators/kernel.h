#pragma once
// The kernels: one reference body and one batch body, each compiled for a few sets of effects; the smallest one that contains
// what a scene calls for is run.

#include <koksma/integrators/tracer.h>

#include <cstddef>
#include <memory>
#include <span>
#include <string_view>

namespace koksma {

/// A compiled variant. All admissible variants give the same bytes: the layout follows the scene, not the kernel.
struct Kernel {
    std::string_view name;  ///< "batch/diffuse": whole pixels in packets; "reference/diffuse": one ray at a time
    EffectSet effects;
    std::size_t batch;      ///< how many samples it wants at once
    /// A null pointer where this CPU lacks what the variant needs.
    std::unique_ptr<Tracer> (*make)(const TraceJob& job);
};

/// All variants: batch kernels, then reference kernels, each smallest first; the last of each has every effect.
[[nodiscard]] std::span<const Kernel> kernels() noexcept;

/// The first variant that contains the effects and runs on this CPU.
[[nodiscard]] const Kernel& choose_kernel(EffectSet effects) noexcept;

/// The largest set of effects of the family of kernels (batch or reference) that these effects are rendered by.
[[nodiscard]] EffectSet largest_effects(EffectSet needed) noexcept;

/// A variant by name. @throws Error naming all, or when it lacks an effect of the scene or the CPU lacks what it needs
[[nodiscard]] const Kernel& find_kernel(std::string_view name, EffectSet needed);

}  // namespace koksma
