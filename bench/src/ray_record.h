#pragma once
// The rays of a render, written down once and asked of Embree again: what tracing alone costs.

#include <koksma/integrators/render.h>

#include <cstdint>
#include <memory>
#include <vector>

namespace koksma {

/// What a replay found, to be compared with what the render found.
struct Answers {
    std::uint64_t hash = 0;                       ///< of ids and visibilities in order
    std::uint64_t closest_hits = 0, blocked = 0;
    friend bool operator==(const Answers&, const Answers&) = default;
    void met(Hit hit) noexcept {
        hash = hash * kFactor + (hit.valid() ? (std::uint64_t{hit.geometry} << 32 | hit.primitive) + 2 : 1);
        closest_hits += hit.valid();
    }
    void shadow(bool is_blocked) noexcept {
        hash = hash * kFactor + is_blocked;
        blocked += is_blocked;
    }

private:
    static constexpr std::uint64_t kFactor = 0x9e3779b97f4a7c15ull;
};

/// Rays of the reference kernel, in the order in which it traces them, for single-ray queries.
class RayRecord {
public:
    /// Traces all samples of the work item with the reference kernel, tile by tile as render() does.
    /// @throws Error when the rays would need more memory than `most_bytes`
    RayRecord(const Scene& scene, const RenderPlan& plan, const SampleSource& source, const WorkItem& work, std::uint64_t most_bytes);

    [[nodiscard]] const Answers& answers() const noexcept { return answers_; }
    [[nodiscard]] RayCounts rays() const noexcept { return rays_; }

    /// One rtcIntersect1 or rtcOccluded1 a ray. @return  CPU seconds of this thread
    [[nodiscard]] double replay(const Accelerator& accelerator, Answers& answers) const noexcept;

private:
    friend struct RayRecorder;
    static constexpr std::size_t kBlock = 8192;
    struct Block {
        Ray rays[kBlock];
        bool shadow[kBlock];
        std::size_t size = 0;
    };
    void add(const Ray& ray, bool shadow);

    std::vector<std::unique_ptr<Block>> blocks_;
    Answers answers_;
    RayCounts rays_;
};

/// Packets that a kernel traced, in its order, for the same packet queries.
class PacketRecord {
public:
    /// To be called for every packet (Accelerator::watch). Those beyond `most_bytes` are counted but not kept.
    void add(const PacketQuery& query, std::uint64_t most_bytes);

    [[nodiscard]] bool empty() const noexcept { return headers_.empty(); }
    [[nodiscard]] bool complete() const noexcept { return dropped_ == 0; }

    /// The packets again, a few at a time put into the cache before their clock starts, as the kernel has them there.
    /// @param answers  counts only: packets have no order of rays
    /// @return         CPU seconds of this thread
    [[nodiscard]] double replay(const Accelerator& accelerator, Answers& answers) const;

private:
    struct Header {
        std::size_t at;        ///< of its first number in rays_
        std::uint32_t active;  ///< one bit a ray
        bool shadow;
        Coherence coherence;
    };
    template <int N>
    [[nodiscard]] double replay_width(const Accelerator& accelerator, Answers& answers) const;

    std::vector<Header> headers_;
    std::vector<float> rays_;
    int width_ = 0;
    std::uint64_t dropped_ = 0;
};

}  // namespace koksma
