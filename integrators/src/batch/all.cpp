#include "batch_ordinary.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "batch/all.cpp"
#include <koksma/simd/each_target.h>

#include "batch_tracer.h"

KOKSMA_MATHS_BEGIN
std::unique_ptr<Tracer> make_all(const TraceJob& job) { return make_batch_tracer<detail::kBatchAllEffects>(job); }
KOKSMA_MATHS_END

#if HWY_ONCE
namespace koksma {
HWY_EXPORT(make_all);
std::unique_ptr<Tracer> detail::make_batch_all(const TraceJob& job) { return HWY_DYNAMIC_DISPATCH(make_all)(job); }
}  // namespace koksma
#endif
