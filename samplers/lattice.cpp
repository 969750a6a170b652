#include "lattice.h"

namespace koksma {
namespace {

constexpr std::uint32_t kVector[] = {
#include "data/lattice_cbc18.inc"
};
static_assert(sizeof(kVector) == kLatticeDimensions * sizeof(std::uint32_t));

}  // namespace

const std::uint32_t* lattice_vector() noexcept { return kVector; }

SamplerInfo LatticeSampler::info() {
    return {.name = "lattice",
            .title = "Rank-1 lattice",
            .paper = "Hickernell et al. 2000, Extensible lattice sequences for quasi-Monte Carlo quadrature",
            .options = {{.name = "randomize",
                         .default_value = "cp",
                         .values = {"none", "cp"},
                         .help = "nothing, shift modulo 1",
                         .always_shown = true},
                        {.name = "tent",
                         .default_value = "off",
                         .values = {"off", "on"},
                         .help = "fold each number after the shift: x -> 1 - |2x - 1|"},
                        pixels_option()},
            .joint = 0,
            .good_counts = {.rule = GoodCounts::Rule::power, .base = 2},
            .remark = "generating vector lattice_cbc18, made for 2^4 to 2^18 samples",
            .max_dimensions = kLatticeDimensions,
            .max_samples = kLatticePoints};
}

LatticeSampler::LatticeSampler(const SamplerOptions& options, const SamplingPlan& plan)
    : keys_(options, plan, 0x6c617474696365ull), vector_(kVector), tent_(options["tent"] == "on"), fixed_(options["randomize"] == "none"),
      shift_(!fixed_ || tent_) {}

}  // namespace koksma
