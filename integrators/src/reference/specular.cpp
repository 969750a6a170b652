#include "reference_tracer.h"

namespace koksma::detail {

std::unique_ptr<Tracer> make_reference_specular(const TraceJob& job) { return std::make_unique<ReferenceTracer<kSpecularEffects>>(job); }

}  // namespace koksma::detail
