#pragma once
// Every difference between Embree 3 and 4 that this project meets.

#if __has_include(<embree4/rtcore.h>)
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif

namespace koksma::embree {

#if RTC_VERSION_MAJOR >= 4
/// What a query of a packet passes on beside the rays.
struct IntersectQuery {
    RTCIntersectArguments arguments;
    explicit IntersectQuery(bool coherent) noexcept {
        rtcInitIntersectArguments(&arguments);
        arguments.flags = coherent ? RTC_RAY_QUERY_FLAG_COHERENT : RTC_RAY_QUERY_FLAG_INCOHERENT;
    }
};
struct OccludedQuery {
    RTCOccludedArguments arguments;
    explicit OccludedQuery(bool coherent) noexcept {
        rtcInitOccludedArguments(&arguments);
        arguments.flags = coherent ? RTC_RAY_QUERY_FLAG_COHERENT : RTC_RAY_QUERY_FLAG_INCOHERENT;
    }
};
inline void intersect(const int* valid, RTCScene s, RTCRayHit4& r, IntersectQuery q) noexcept { rtcIntersect4(valid, s, &r, &q.arguments); }
inline void intersect(const int* valid, RTCScene s, RTCRayHit8& r, IntersectQuery q) noexcept { rtcIntersect8(valid, s, &r, &q.arguments); }
inline void intersect(const int* valid, RTCScene s, RTCRayHit16& r, IntersectQuery q) noexcept { rtcIntersect16(valid, s, &r, &q.arguments); }
inline void occluded(const int* valid, RTCScene s, RTCRay4& r, OccludedQuery q) noexcept { rtcOccluded4(valid, s, &r, &q.arguments); }
inline void occluded(const int* valid, RTCScene s, RTCRay8& r, OccludedQuery q) noexcept { rtcOccluded8(valid, s, &r, &q.arguments); }
inline void occluded(const int* valid, RTCScene s, RTCRay16& r, OccludedQuery q) noexcept { rtcOccluded16(valid, s, &r, &q.arguments); }
#else
struct Query {
    RTCIntersectContext context;
    explicit Query(bool coherent) noexcept {
        rtcInitIntersectContext(&context);
        context.flags = coherent ? RTC_INTERSECT_CONTEXT_FLAG_COHERENT : RTC_INTERSECT_CONTEXT_FLAG_INCOHERENT;
    }
};
using IntersectQuery = Query;
using OccludedQuery = Query;
inline void intersect(const int* valid, RTCScene s, RTCRayHit4& r, Query q) noexcept { rtcIntersect4(valid, s, &q.context, &r); }
inline void intersect(const int* valid, RTCScene s, RTCRayHit8& r, Query q) noexcept { rtcIntersect8(valid, s, &q.context, &r); }
inline void intersect(const int* valid, RTCScene s, RTCRayHit16& r, Query q) noexcept { rtcIntersect16(valid, s, &q.context, &r); }
inline void occluded(const int* valid, RTCScene s, RTCRay4& r, Query q) noexcept { rtcOccluded4(valid, s, &q.context, &r); }
inline void occluded(const int* valid, RTCScene s, RTCRay8& r, Query q) noexcept { rtcOccluded8(valid, s, &q.context, &r); }
inline void occluded(const int* valid, RTCScene s, RTCRay16& r, Query q) noexcept { rtcOccluded16(valid, s, &q.context, &r); }
#endif

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
