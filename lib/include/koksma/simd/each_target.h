// Compiles the rest of the including file once for each instruction set. See maths.h for how to use it. No include guard: it
// is read anew for each.

// Shared maths to compile for each set; a file that wants more than the elementary functions defines it before.
#ifndef KOKSMA_SHARED_MATHS
#define KOKSMA_SHARED_MATHS <koksma/simd/elementary.h>
#endif

#ifndef KOKSMA_EACH_TARGET
#define KOKSMA_EACH_TARGET
// The ordinary forms come first, whatever the file included before: the toggles count on it.
#include KOKSMA_SHARED_MATHS
// Highway would make more sets than are worth their compile time. A machine without SSE4 runs its emulation.
#define HWY_DISABLED_TARGETS (HWY_SSSE3 | HWY_AVX3_DL | HWY_SVE | HWY_SVE2 | HWY_RVV)
#endif

#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#ifdef KOKSMA_MATHS_TOGGLE
#undef KOKSMA_MATHS_TOGGLE
#else
#define KOKSMA_MATHS_TOGGLE
#endif
#undef KOKSMA_ORDINARY
#undef KOKSMA_MATHS_BEGIN
#undef KOKSMA_MATHS_END
#define KOKSMA_MATHS_BEGIN  \
    HWY_BEFORE_NAMESPACE(); \
    namespace koksma::HWY_NAMESPACE {
#define KOKSMA_MATHS_END \
    }                    \
    HWY_AFTER_NAMESPACE();

#include <koksma/simd/pack.h>
#include <koksma/simd/rows.h>
#include KOKSMA_SHARED_MATHS
