#include "reference_tracer.h"

namespace koksma::detail {

std::unique_ptr<Tracer> make_reference_diffuse(const TraceJob& job) { return std::make_unique<ReferenceTracer<kDiffuseEffects>>(job); }

}  // namespace koksma::detail
