#pragma once
// Rows of inputs and outputs that BSDF benchmarks share; packs read as many of each as they have lanes.

#include <koksma/scene/bsdf/bsdf.h>

#include <cstddef>

namespace koksma::micro {

inline constexpr std::size_t kBsdfInputs = 4096;

struct alignas(64) BsdfRows {
    float wo_x[kBsdfInputs], wo_y[kBsdfInputs], wo_z[kBsdfInputs];
    float wi_x[kBsdfInputs], wi_y[kBsdfInputs], wi_z[kBsdfInputs];
    float u_lobe[kBsdfInputs], u_x[kBsdfInputs], u_y[kBsdfInputs];
    float out[kBsdfInputs];  ///< a sum of all that came out, so that nothing is left out
};

/// All inputs in packs of the widest instruction set.
void sample_packs(const Bsdf& bsdf, BsdfRows& rows);
void eval_packs(const Bsdf& bsdf, BsdfRows& rows);

}  // namespace koksma::micro
