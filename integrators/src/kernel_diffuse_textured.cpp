#include "kernel_body.h"

namespace koksma::detail {

template void trace_block<kDiffuseTexturedEffects>(const Scene&, const IntegratorSettings&, Draws&, std::span<Vec3f>, RayCounts&) noexcept;

}  // namespace koksma::detail
