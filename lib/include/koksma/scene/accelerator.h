#pragma once
// Which primitive a ray meets first. The only thing asked of Embree; one source file includes it.

#include <koksma/scene/analytic.h>
#include <koksma/scene/ray.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>

namespace koksma {

/// A robust Embree scene (watertight at edges, no leaks). Geometries get the ids 0, 1, 2, ... in the order of adding.
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
    /// Builds the BVH with all of TBB's threads.
    void commit();

    [[nodiscard]] Hit intersect(const Ray& ray) const noexcept;
    /// True if anything lies between t_near and t_far.
    [[nodiscard]] bool occluded(const Ray& ray) const noexcept;
    /// "Embree 3.13.5"
    [[nodiscard]] static const char* version() noexcept;

private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace koksma
