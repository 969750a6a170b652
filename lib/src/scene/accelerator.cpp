#include <koksma/sampling/error.h>
#include <koksma/scene/accelerator.h>

#include <koksma/scene/ray_offset.h>

#include "embree.h"

#include <tbb/task_arena.h>

#include <algorithm>
#include <cstddef>
#include <deque>
#include <limits>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace koksma {

namespace {

/// Embree keeps coordinates below this; it drops, in silence, a triangle with a larger one.
constexpr float kLargestCoordinate = 1.844e18f;

struct UserShape {
    std::variant<AnalyticSphere, AnalyticDisk, AnalyticCylinder> shape;
    unsigned geometry = 0;
};

float first_hit(const UserShape& user, const Ray& ray) noexcept {
    if (const auto* sphere = std::get_if<AnalyticSphere>(&user.shape)) return static_cast<float>(intersect(*sphere, ray));
    if (const auto* disk = std::get_if<AnalyticDisk>(&user.shape)) return static_cast<float>(intersect(*disk, ray).t);
    return static_cast<float>(intersect(std::get<AnalyticCylinder>(user.shape), ray).t);
}

Ray ray_of(RTCRayN* rays, unsigned n, unsigned i) noexcept {
    return {{RTCRayN_org_x(rays, n, i), RTCRayN_org_y(rays, n, i), RTCRayN_org_z(rays, n, i)},
            {RTCRayN_dir_x(rays, n, i), RTCRayN_dir_y(rays, n, i), RTCRayN_dir_z(rays, n, i)},
            RTCRayN_tnear(rays, n, i),
            RTCRayN_tfar(rays, n, i)};
}

void intersect_user(const RTCIntersectFunctionNArguments* args) {
    const auto& user = *static_cast<const UserShape*>(args->geometryUserPtr);
    RTCRayN* rays = RTCRayHitN_RayN(args->rayhit, args->N);
    RTCHitN* hits = RTCRayHitN_HitN(args->rayhit, args->N);
    for (unsigned i = 0; i < args->N; ++i) {
        if (args->valid[i] == 0) continue;
        const float t = first_hit(user, ray_of(rays, args->N, i));
        if (!(t < RTCRayN_tfar(rays, args->N, i))) continue;
        RTCRayN_tfar(rays, args->N, i) = t;
        RTCHitN_geomID(hits, args->N, i) = user.geometry;
        RTCHitN_primID(hits, args->N, i) = 0;
        RTCHitN_instID(hits, args->N, i, 0) = args->context->instID[0];
    }
}

void occluded_user(const RTCOccludedFunctionNArguments* args) {
    const auto& user = *static_cast<const UserShape*>(args->geometryUserPtr);
    for (unsigned i = 0; i < args->N; ++i) {
        if (args->valid[i] == 0) continue;
        const Ray ray = ray_of(args->ray, args->N, i);
        if (first_hit(user, ray) < ray.t_far) RTCRayN_tfar(args->ray, args->N, i) = -kInfinity;
    }
}

void bounds_user(const RTCBoundsFunctionArguments* args) {
    const auto& user = *static_cast<const UserShape*>(args->geometryUserPtr);
    Vec3d center, extent;
    if (const auto* sphere = std::get_if<AnalyticSphere>(&user.shape)) {
        center = sphere->center;
        extent = Vec3d(sphere->radius);
    } else if (const auto* cylinder = std::get_if<AnalyticCylinder>(&user.shape)) {
        center = cylinder->base + cylinder->axis * 0.5;
        extent = reach(*cylinder);
    } else {
        const auto& disk = std::get<AnalyticDisk>(user.shape);
        center = disk.center;
        extent = {std::hypot(disk.s.x, disk.t.x), std::hypot(disk.s.y, disk.t.y), std::hypot(disk.s.z, disk.t.z)};
    }
    // Outward by a few roundings: the box is in float, the shape in double.
    const auto low = [](double c, double e) { return next_float<float>(next_float<float>(static_cast<float>(c - e), false), false); };
    const auto high = [](double c, double e) { return next_float<float>(next_float<float>(static_cast<float>(c + e), true), true); };
    args->bounds_o->lower_x = low(center.x, extent.x);
    args->bounds_o->lower_y = low(center.y, extent.y);
    args->bounds_o->lower_z = low(center.z, extent.z);
    args->bounds_o->upper_x = high(center.x, extent.x);
    args->bounds_o->upper_y = high(center.y, extent.y);
    args->bounds_o->upper_z = high(center.z, extent.z);
}

/// Rays begin after their origin. Where a coordinate of a wall is exactly 0, so is the bound of its error, and rays that leave the wall start in it;
/// Embree's robust mode meets what lies at t = 0.
constexpr float after_start(float t_near) noexcept { return std::max(t_near, std::numeric_limits<float>::min()); }

RTCRay embree_ray(const Ray& ray) noexcept {
    RTCRay r{};
    r.org_x = ray.o.x;
    r.org_y = ray.o.y;
    r.org_z = ray.o.z;
    r.dir_x = ray.d.x;
    r.dir_y = ray.d.y;
    r.dir_z = ray.d.z;
    r.tnear = after_start(ray.t_near);
    r.tfar = ray.t_far;
    r.time = ray.time;
    r.mask = ~0u;
    return r;
}

template <int N>
struct Packet;
template <>
struct Packet<4> {
    using RayHit = RTCRayHit4;
    using Ray = RTCRay4;
};
template <>
struct Packet<8> {
    using RayHit = RTCRayHit8;
    using Ray = RTCRay8;
};
template <>
struct Packet<16> {
    using RayHit = RTCRayHit16;
    using Ray = RTCRay16;
};
template <int N>
constexpr bool same_layout() {
    using Own = RayPacket<N>;
    using RayHit = typename Packet<N>::RayHit;
    using Ray = typename Packet<N>::Ray;
    using Hits = decltype(RayHit::hit);
    constexpr std::size_t hit = offsetof(RayHit, hit);
    return sizeof(RayHit) <= sizeof(Own) && alignof(RayHit) <= alignof(Own) && offsetof(RayHit, ray) == 0 &&
           offsetof(Ray, org_x) == offsetof(Own, o_x) && offsetof(Ray, tnear) == offsetof(Own, t_near) && offsetof(Ray, dir_x) == offsetof(Own, d_x) &&
           offsetof(Ray, time) == offsetof(Own, time) && offsetof(Ray, tfar) == offsetof(Own, t_far) && offsetof(Ray, mask) == offsetof(Own, mask) &&
           offsetof(Ray, flags) == offsetof(Own, flags) && hit + offsetof(Hits, primID) == offsetof(Own, primitive) &&
           hit + offsetof(Hits, geomID) == offsetof(Own, geometry) && hit + offsetof(Hits, instID) == offsetof(Own, instance);
}
static_assert(same_layout<4>() && same_layout<8>() && same_layout<16>(), "RayPacket must be laid out as this version of Embree wants it");

}  // namespace

struct Accelerator::Impl {
    RTCDevice device = nullptr;
    RTCScene scene = nullptr;
    std::vector<RTCScene> groups;
    std::deque<UserShape> shapes;  // a deque: addresses are handed to Embree
    std::vector<std::pair<RTCScene, unsigned>> geometries;
    bool committed = false;
    std::function<void(const PacketQuery&)> watcher;

    Impl() {
        // No "threads=": Embree would cap TBB for the whole process.
        device = rtcNewDevice(nullptr);
        if (device == nullptr) throw Error("Embree cannot make a device (code " + std::to_string(rtcGetDeviceError(nullptr)) + ")");
        scene = rtcNewScene(device);
        rtcSetSceneBuildQuality(scene, RTC_BUILD_QUALITY_HIGH);
    }
    ~Impl() {
        rtcReleaseScene(scene);
        for (const RTCScene group : groups) rtcReleaseScene(group);
        rtcReleaseDevice(device);
    }
    Impl(const Impl&) = delete;
    Impl& operator=(const Impl&) = delete;

    /// Where geometries go to now.
    [[nodiscard]] RTCScene open() const { return groups.empty() ? scene : groups.back(); }
    /// @return  its id
    unsigned attach(RTCScene to, RTCGeometry geometry) {
        rtcSetGeometryMask(geometry, ~0u);  // Embree 4 defaults to 1, Embree 3 to all
        rtcCommitGeometry(geometry);
        const unsigned id = rtcAttachGeometry(to, geometry);
        geometries.emplace_back(to, id);
        rtcReleaseGeometry(geometry);
        check();
        return id;
    }
    void add_user(UserShape shape) {
        RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_USER);
        shapes.push_back(std::move(shape));
        rtcSetGeometryUserPrimitiveCount(geometry, 1);
        rtcSetGeometryUserData(geometry, &shapes.back());
        rtcSetGeometryBoundsFunction(geometry, bounds_user, nullptr);
        rtcSetGeometryIntersectFunction(geometry, intersect_user);
        rtcSetGeometryOccludedFunction(geometry, occluded_user);
        shapes.back().geometry = attach(open(), geometry);
    }
    void commit(RTCScene s, bool robust) const {
        rtcSetSceneFlags(s, robust ? RTC_SCENE_FLAG_ROBUST : RTC_SCENE_FLAG_NONE);
        rtcCommitScene(s);
    }
    void check() const {
        if (const RTCError code = rtcGetDeviceError(device); code != RTC_ERROR_NONE)
            throw Error(code == RTC_ERROR_OUT_OF_MEMORY ? "Embree is out of memory" : "Embree reports error " + std::to_string(code));
    }
};

Accelerator::Accelerator() : impl_(std::make_unique<Impl>()) {}
Accelerator::~Accelerator() = default;
Accelerator::Accelerator(Accelerator&&) noexcept = default;
Accelerator& Accelerator::operator=(Accelerator&&) noexcept = default;

void Accelerator::add_mesh(std::span<const Vec3f> vertices, std::span<const std::array<std::uint32_t, 3>> triangles) {
    RTCGeometry geometry = rtcNewGeometry(impl_->device, RTC_GEOMETRY_TYPE_TRIANGLE);
    rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, vertices.data(), 0, sizeof(Vec3f), vertices.size());
    rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, triangles.data(), 0, sizeof(triangles[0]),
                               triangles.size());
    impl_->attach(impl_->open(), geometry);
}

void Accelerator::begin_group() {
    impl_->groups.push_back(rtcNewScene(impl_->device));
    rtcSetSceneBuildQuality(impl_->groups.back(), RTC_BUILD_QUALITY_HIGH);
}

void Accelerator::add_instance(std::uint32_t group, std::span<const Placement> placements) {
    RTCGeometry geometry = rtcNewGeometry(impl_->device, RTC_GEOMETRY_TYPE_INSTANCE);
    rtcSetGeometryInstancedScene(geometry, impl_->groups.at(group));
    rtcSetGeometryTimeStepCount(geometry, static_cast<unsigned>(placements.size()));
    for (std::size_t i = 0; i < placements.size(); ++i) {
        const Placement& p = placements[i];
        const Vec3f columns[4] = {to_float(p.x), to_float(p.y), to_float(p.z), to_float(p.t)};
        rtcSetGeometryTransform(geometry, static_cast<unsigned>(i), RTC_FORMAT_FLOAT3X4_COLUMN_MAJOR, columns);
    }
    impl_->attach(impl_->scene, geometry);
}

void Accelerator::add_sphere(const AnalyticSphere& sphere) {
    if (!(length(sphere.center) + sphere.radius < kLargestCoordinate)) throw Error("a sphere reaches farther from the camera than 1.8e18, or is not finite");
    impl_->add_user({sphere});
}
void Accelerator::add_disk(const AnalyticDisk& disk) {
    if (!(length(disk.center) + length(disk.s) + length(disk.t) < kLargestCoordinate))
        throw Error("a disk reaches farther from the camera than 1.8e18, or is not finite");
    impl_->add_user({disk});
}

void Accelerator::add_cylinder(const AnalyticCylinder& cylinder) {
    if (!(length(cylinder.base) + length(cylinder.axis) + cylinder.radius < kLargestCoordinate))
        throw Error("a cylinder reaches farther from the camera than 1.8e18, or is not finite");
    impl_->add_user({cylinder});
}

void Accelerator::watch(std::function<void(const PacketQuery&)> watcher) { impl_->watcher = std::move(watcher); }

void Accelerator::commit(bool robust) {
    // Embree builds anew only what it takes for changed.
    if (impl_->committed)
        for (const auto& [scene, id] : impl_->geometries) rtcCommitGeometry(rtcGetGeometry(scene, id));
    impl_->committed = true;
    // Embree flushes denormals while it builds, and the first TBB task of a process sets the mode of all later ones: without
    // an arena of its own the host's tasks would flush for ever.
    tbb::task_arena().execute([&] {
        for (const RTCScene group : impl_->groups) impl_->commit(group, robust);
        impl_->commit(impl_->scene, robust);
    });
    impl_->check();
}

Hit Accelerator::intersect(const Ray& ray) const noexcept {
    RTCRayHit rh;
    rh.ray = embree_ray(ray);
    rh.hit.geomID = rh.hit.primID = rh.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;  // Embree writes none where it meets nothing
    embree::intersect1(impl_->scene, rh);
    return {rh.hit.geomID, rh.hit.primID, rh.hit.instID[0]};
}

bool Accelerator::occluded(const Ray& ray) const noexcept {
    RTCRay r = embree_ray(ray);
    embree::occluded1(impl_->scene, r);
    return r.tfar < 0.0f;
}

template <int N>
void Accelerator::intersect(RayPacket<N>& rays, const std::int32_t* valid, Coherence coherence) const noexcept {
    for (float& t : rays.t_near) t = after_start(t);
    if (impl_->watcher) impl_->watcher({N, false, coherence, rays.o_x, valid});
    embree::intersect(valid, impl_->scene, reinterpret_cast<typename Packet<N>::RayHit&>(rays), embree::IntersectQuery(coherence == Coherence::coherent));
}
template <int N>
void Accelerator::occluded(RayPacket<N>& rays, const std::int32_t* valid, Coherence coherence) const noexcept {
    for (float& t : rays.t_near) t = after_start(t);
    if (impl_->watcher) impl_->watcher({N, true, coherence, rays.o_x, valid});
    embree::occluded(valid, impl_->scene, reinterpret_cast<typename Packet<N>::Ray&>(rays), embree::OccludedQuery(coherence == Coherence::coherent));
}
template void Accelerator::intersect(RayPacket<4>&, const std::int32_t*, Coherence) const noexcept;
template void Accelerator::intersect(RayPacket<8>&, const std::int32_t*, Coherence) const noexcept;
template void Accelerator::intersect(RayPacket<16>&, const std::int32_t*, Coherence) const noexcept;
template void Accelerator::occluded(RayPacket<4>&, const std::int32_t*, Coherence) const noexcept;
template void Accelerator::occluded(RayPacket<8>&, const std::int32_t*, Coherence) const noexcept;
template void Accelerator::occluded(RayPacket<16>&, const std::int32_t*, Coherence) const noexcept;

const char* Accelerator::version() noexcept { return "Embree " RTC_VERSION_STRING; }

}  // namespace koksma
