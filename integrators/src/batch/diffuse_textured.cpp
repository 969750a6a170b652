#include "batch_ordinary.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "batch/diffuse_textured.cpp"
#include <koksma/simd/each_target.h>

#include "batch_tracer.h"

KOKSMA_MATHS_BEGIN
std::unique_ptr<Tracer> make_diffuse_textured(const TraceJob& job) { return make_batch_tracer<detail::kDiffuseTexturedEffects>(job); }
KOKSMA_MATHS_END

#if HWY_ONCE
namespace koksma {
HWY_EXPORT(make_diffuse_textured);
std::unique_ptr<Tracer> detail::make_batch_diffuse_textured(const TraceJob& job) { return HWY_DYNAMIC_DISPATCH(make_diffuse_textured)(job); }
}  // namespace koksma
#endif
