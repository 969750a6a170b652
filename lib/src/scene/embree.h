#pragma once
// Every difference between Embree 3 and 4 that this project meets.

#if __has_include(<embree4/rtcore.h>)
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif

#include <string>

namespace koksma::embree {

/// Closest hit of one ray, all geometry, incoherent.
inline void intersect1(RTCScene scene, RTCRayHit& ray_hit) noexcept {
#if RTC_VERSION_MAJOR >= 4
    rtcIntersect1(scene, &ray_hit);
#else
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    rtcIntersect1(scene, &context, &ray_hit);
#endif
}

/// Any hit of one ray: afterwards ray.tfar is -inf.
inline void occluded1(RTCScene scene, RTCRay& ray) noexcept {
#if RTC_VERSION_MAJOR >= 4
    rtcOccluded1(scene, &ray);
#else
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    rtcOccluded1(scene, &context, &ray);
#endif
}

}  // namespace koksma::embree
