// What a render is made of, besides samplers (samplers.cpp): one thread, CPU time. The counters per_... are the result.
//
//     query/<scene>/<rays>/<width>/<flag>   closest hits and occlusion tests by packet width (1: single rays) and coherence flag
//     bsdf/<what>/<form>/<kind>             sampling and evaluation, one by one and in packs
//     kernel/<scene>/<variant>              whole paths
//     film/<what>
//
// KOKSMA_TARGET=AVX2 (koksma/simd/targets.h) in the environment limits the instruction set of packs and kernels.

#include "render.h"

#include <koksma/integrators/float_mode.h>
#include <koksma/sampling/error.h>
#include <koksma/simd/targets.h>

#include <cstdio>
#include <cstdlib>

int main(int argc, char** argv) {
    benchmark::Initialize(&argc, argv);
    if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;
    try {
        if (const char* target = std::getenv("KOKSMA_TARGET")) koksma::simd::use_target(target);
        benchmark::AddCustomContext("simd_target", koksma::simd::target());
        koksma::micro::register_queries();
        koksma::micro::register_bsdfs();
        koksma::micro::register_kernels();
    } catch (const koksma::Error& e) {
        std::fprintf(stderr, "koksma_micro_render: %s\n", e.what());
        return 1;
    }
    const koksma::FlushDenormals flush;  // as in rendering
    benchmark::RunSpecifiedBenchmarks();
    benchmark::Shutdown();
    return 0;
}
