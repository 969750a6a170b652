#pragma once
// Which primitive a ray meets first. The only thing asked of Embree; one source file includes it.

#include <koksma/scene/analytic.h>
#include <koksma/scene/placement.h>
#include <koksma/scene/ray.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>

namespace koksma {

/// N rays side by side (4, 8 or 16), and what they met. Laid out as Embree's own packets, so that nothing is copied.
template <int N>
struct alignas(4 * N) RayPacket {
    float o_x[N], o_y[N], o_z[N], t_near[N], d_x[N], d_y[N], d_z[N], time[N], t_far[N];
    std::uint32_t mask[N], id[N], flags[N];
    float reserved[5][N];
    std::uint32_t primitive[N], geometry[N], instance[2][N];  ///< geometry: Hit::kNone where nothing was met
};

/// How alike the rays of a packet are. `coherent` for rays from one point through neighbouring pixels; it is dear elsewhere.
enum class Coherence : std::uint8_t { incoherent, coherent };

/// A query of a packet, as a watcher sees it.
struct PacketQuery {
    int width = 0;                     ///< N of the packet
    bool shadow = false;
    Coherence coherence = Coherence::incoherent;
    const float* rays = nullptr;       ///< the packet's rows from o_x to t_far
    const std::int32_t* valid = nullptr;
};

/// A robust Embree scene (watertight at edges, no leaks). Geometries, and behind them instances, get the ids 0, 1, 2, ... in the order of
/// adding; those of a group count from 0 anew.
/// Thread-safe once committed. Rays must be finite with a direction that is not zero: callers check.
class Accelerator {
public:
    Accelerator();
    ~Accelerator();
    Accelerator(Accelerator&&) noexcept;
    Accelerator& operator=(Accelerator&&) noexcept;

    /// The vertices are shared, not copied; they must outlive this, with 4 readable bytes after the last.
    void add_mesh(std::span<const Vec3f> vertices, std::span<const std::array<std::uint32_t, 3>> triangles);
    void add_sphere(const AnalyticSphere& sphere);
    void add_disk(const AnalyticDisk& disk);
    void add_cylinder(const AnalyticCylinder& cylinder);
    /// Geometries that are added from now on belong to a new group: groups count 0, 1, 2, ... and are seen through instances alone.
    void begin_group();
    /// Shows a group. After all geometries.
    /// @param placements  into the scene's space, entries that are floats; of several, at equal distances in the time [0, 1], each entry
    ///                    is interpolated linearly
    void add_instance(std::uint32_t group, std::span<const Placement> placements);
    /// Builds the BVH with all of TBB's threads. Once more: builds it anew.
    /// @param robust  false only to measure what it costs: rays then slip through edges
    void commit(bool robust = true);
    /// Calls the watcher before every packet, for measurements with one thread; an empty one ends that.
    void watch(std::function<void(const PacketQuery&)> watcher);

    /// @return  what is met, by the ids of above: closest_hit() (koksma/scene/instance.h) turns those of instances into a Hit's
    [[nodiscard]] Hit intersect(const Ray& ray) const noexcept;
    /// True if anything lies between t_near and t_far.
    [[nodiscard]] bool occluded(const Ray& ray) const noexcept;
    /// The same for packets of 4, 8 or 16 rays. Rays with valid[i] == 0 are left alone, the others (-1) answered as single ones.
    /// Sets geometry and instance (kNone first, by the caller) and primitive.
    template <int N>
    void intersect(RayPacket<N>& rays, const std::int32_t* valid, Coherence coherence) const noexcept;
    /// Sets t_far to -infinity where something lies in between. Ids need not be set.
    template <int N>
    void occluded(RayPacket<N>& rays, const std::int32_t* valid, Coherence coherence) const noexcept;
    /// "Embree 3.13.5"
    [[nodiscard]] static const char* version() noexcept;

private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace koksma
