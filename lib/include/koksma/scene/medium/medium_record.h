#pragma once
// A medium ready to be rendered.

#include <koksma/scene/medium/volume_field.h>

namespace koksma {

struct MediumRecord {
    bool heterogeneous = false;
    bool grey = false;  ///< the extinction is the same in all channels
    bool sample_emitters = true;
    float g = 0.0f;         ///< of the phase function
    Vec3f sigma_t;          ///< extinction of a homogeneous medium, m^-1
    float majorant = 0.0f;  ///< of a heterogeneous one: no channel is above it anywhere
    float scale = 1.0f;     ///< of `density`
    VolumeField density;    ///< extinction of a heterogeneous medium, over `scale`
    VolumeField albedo;
    Vec3f low, high;  ///< corners of the box beyond which a heterogeneous medium is empty
};

/// What is on both sides of a surface.
struct MediumBoundary {
    bool ends_media = false;    ///< false: the medium on one side goes on behind the surface
    std::int32_t interior = -1, exterior = -1;  ///< indices into Scene::media; -1: vacuum
};

}  // namespace koksma
