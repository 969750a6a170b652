#include "reference_tracer.h"

namespace koksma::detail {

std::unique_ptr<Tracer> make_reference_surfaces(const TraceJob& job) { return std::make_unique<ReferenceTracer<kSurfaceEffects>>(job); }

}  // namespace koksma::detail
