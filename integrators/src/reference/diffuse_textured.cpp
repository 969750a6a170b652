#include "reference_tracer.h"

namespace koksma::detail {

std::unique_ptr<Tracer> make_reference_diffuse_textured(const TraceJob& job) { return std::make_unique<ReferenceTracer<kDiffuseTexturedEffects>>(job); }

}  // namespace koksma::detail
