// Every header of shared maths, in the order in which they build on each other. No include guard: see maths.h.
#include <koksma/math/vec3.h>
#include <koksma/simd/elementary.h>
#include <koksma/sampling/warps.h>
#include <koksma/scene/bsdf/fresnel.h>
#include <koksma/scene/bsdf/microfacet.h>
#include <koksma/scene/bsdf/bsdf.h>
#include <koksma/scene/ray_offset.h>
#include <koksma/scene/triangle.h>
#include <koksma/scene/light_maths.h>
#include <koksma/scene/camera.h>
#include <koksma/scene/environment_value.h>
#include <koksma/scene/environment_direction.h>
