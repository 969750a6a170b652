#pragma once
// <sensor> with its <film> and <sampler>.

#include "context.h"

namespace koksma::loader {

/// Fills camera, film, sampler, spp and seed. @throws Error
void read_sensor(const Element& sensor, Context& context);

/// Horizontal angle in degrees, from 'fov' and 'fov_axis' or from 'focal_length'. @throws Error
[[nodiscard]] double read_fov(Properties& p, double aspect);

/// @throws Error if a transform scales or shears. `what` names its owner
void check_frame(const glm::dmat4& m, std::string_view what, const SourceLocation& where);

/// @throws Error
void read_film(const Element& film, Context& context);

/// @throws Error
void read_sampler(const Element& sampler, Context& context);

/// @throws Error
void read_integrator(const Element& integrator, Context& context);

}  // namespace koksma::loader
