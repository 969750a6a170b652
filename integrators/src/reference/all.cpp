#include "reference_tracer.h"

namespace koksma::detail {

std::unique_ptr<Tracer> make_reference_all(const TraceJob& job) { return std::make_unique<ReferenceTracer<EffectSet::all()>>(job); }

}  // namespace koksma::detail
