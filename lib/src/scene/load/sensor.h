#pragma once
// <sensor> with its <film> and <sampler>.

#include "context.h"

namespace koksma::loader {

/// Fills camera, film, sampler, spp and seed. @throws Error
void read_sensor(const Element& sensor, Context& context);

/// @throws Error
void read_film(const Element& film, Context& context);

/// @throws Error
void read_sampler(const Element& sampler, Context& context);

/// @throws Error
void read_integrator(const Element& integrator, Context& context);

}  // namespace koksma::loader
