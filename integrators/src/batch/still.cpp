#include "batch_ordinary.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "batch/still.cpp"
#include <koksma/simd/each_target.h>

#include "batch_tracer.h"

KOKSMA_MATHS_BEGIN
std::unique_ptr<Tracer> make_still(const TraceJob& job) { return make_batch_tracer<detail::kStillEffects>(job); }
KOKSMA_MATHS_END

#if HWY_ONCE
namespace koksma {
HWY_EXPORT(make_still);
std::unique_ptr<Tracer> detail::make_batch_still(const TraceJob& job) { return HWY_DYNAMIC_DISPATCH(make_still)(job); }
}  // namespace koksma
#endif
