#pragma once
// The recursive estimator of the rendering equation: light that arrives along a ray is what the surface emits and what it scatters of the
// light that arrives there. To be read beside a lecture; renders that are to be fast use the production kernels
// (koksma/integrators/path.h), whose expectation this has where the settings coincide.

#include <koksma/integrators/lecture/estimator.h>
#include <koksma/integrators/lecture/ledger.h>
#include <koksma/integrators/lecture/neumann.h>
#include <koksma/sampling/sample_source.h>
#include <koksma/scene/surface.h>

#include <optional>

namespace koksma {

/// One object per thread.
class RecursiveEstimator {
public:
    /// @param plan  of make_plan(scene, integrator, settings)
    RecursiveEstimator(const Scene& scene, const RenderPlan& plan, const SampleSource& source, const EstimatorSettings& settings) noexcept
        : scene_(scene), plan_(plan), source_(source), settings_(settings) {}

    /// The radiance of one camera sample: linear RGB, W sr^-1 m^-2; NaN if a ray could not be traced.
    [[nodiscard]] NeumannSeries sample(SampleId id) noexcept;

    [[nodiscard]] Ledger& ledger() noexcept { return ledger_; }

private:
    /// A ray, what it counts for, and how it came to be.
    struct Branch {
        Ray ray;
        Vec3f throughput{1.0f};       ///< f |cos| / (pdf x survival) of all directions so far
        float eta_scale = 1.0f;       ///< square of the index that it is in: what the throughput lost by compression
        float pdf = 0.0f;             ///< of its direction, per steradian
        bool delta = true;            ///< light sampling could not have made its direction
        Vec3f from{}, from_normal{};  ///< the point that it left, as lights were chosen there
        std::uint32_t depth = 0;      ///< vertices before it
        std::uint32_t lossless = 0;   ///< bounces in a row after which nothing was lost
        std::uint64_t number = 0;     ///< among the rays of its level of all samples of the pixel
    };
    /// A surface that is to scatter light.
    struct Vertex {
        Surface surface;
        LocalBsdf local;
        Vec3f wo;  ///< local
    };
    /// A continued ray, and the factor of its radiance at the vertex that it left.
    struct Continued {
        Branch branch;
        Vec3f weight;
    };
    /// The random numbers of one draw at a vertex.
    struct Numbers;

    [[nodiscard]] NeumannSeries arriving(const Branch& along) noexcept;
    [[nodiscard]] Vec3f environment(const Branch& along) const noexcept;
    [[nodiscard]] Vec3f emission(const Branch& along, Hit hit, const Surface& surface) const noexcept;
    [[nodiscard]] Vec3f direct_light(const Vertex& at, const Numbers& u) noexcept;
    [[nodiscard]] std::optional<Continued> continuation(const Branch& along, const Vertex& at, Numbers& u) noexcept;
    /// What meeting a light counts for that light sampling might have found as well.
    [[nodiscard]] float weight_of_met(const Branch& along, float pdf_light) const noexcept;
    [[nodiscard]] bool draws_uniformly(const Vertex& at) const noexcept;
    /// Plays for a ray whose throughput (survival not yet divided out) is given. @return  1 / survival, or 0: lost
    [[nodiscard]] float play(float survival, bool survives, Vec3f throughput, std::uint32_t depth) noexcept;
    /// Weight of a ray in its camera sample.
    [[nodiscard]] double weight_of(Vec3f throughput, std::uint32_t depth) const noexcept;
    void truncate(Vec3f throughput, std::uint32_t depth) noexcept;

    const Scene& scene_;
    const RenderPlan& plan_;
    const SampleSource& source_;
    const EstimatorSettings settings_;
    Ledger ledger_;
    Pixel pixel_{};
};

}  // namespace koksma
