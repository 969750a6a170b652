#include "reference_tracer.h"

namespace koksma::detail {

std::unique_ptr<Tracer> make_reference_still(const TraceJob& job) { return std::make_unique<ReferenceTracer<kStillEffects>>(job); }

}  // namespace koksma::detail
