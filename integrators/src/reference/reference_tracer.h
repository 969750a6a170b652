#pragma once
// The reference kernel as a tracer: blocks of 64 samples, one path after the other.

#include <koksma/integrators/volume_path.h>

#include "../flatten.h"
#include "../kernel_sets.h"

namespace koksma::detail {

/// Watches what a path meets.
struct HashObserver : NoObserver {
    std::uint64_t hash = 0;
    void met(const Ray&, Hit hit) noexcept {
        hash = path_hash(hash, (std::uint64_t{hit.geometry} << 32) | hit.primitive);
        if (hit.instance != Hit::kNone) hash = path_hash(hash, hit.instance);
    }
    void shadow(const Ray&, bool visible) noexcept { hash = path_hash(hash, visible); }
};

template <EffectSet kEffects>
class ReferenceTracer final : public Tracer {
public:
    explicit ReferenceTracer(const TraceJob& job) : scene_(job.scene), plan_(job.plan), draws_(job.plan, job.source) {}

    /// In one piece: points and BSDFs passed through memory cost a tenth of the time.
    KOKSMA_FLATTEN void trace(std::span<const SampleId> ids, std::span<Vec3f> radiance, std::span<std::uint64_t> hashes) noexcept override {
        constexpr std::uint64_t kTimedEvery = 16;  // blocks: the fills of one in so many are done again and timed
        const bool timed = block_++ % kTimedEvery == 0;
        draws_.begin(ids, timed);
        for (std::size_t i = 0; i < ids.size(); ++i) {
            draws_.select(i);
            if (hashes.empty()) {
                NoObserver nobody;
                radiance[i] = trace_one(nobody);
            } else {
                HashObserver observer;
                radiance[i] = trace_one(observer);
                hashes[i] = observer.hash;
            }
        }
        if (timed) {
            const double seconds = draws_.seconds_of_fills();
            stats_.sampler_seconds += seconds;
            stats_.idle_seconds += seconds;
            stats_.timed_paths += ids.size();
        }
        stats_.tail_numbers = draws_.tail_numbers;
    }

private:
    template <class Observer>
    [[nodiscard]] Vec3f trace_one(Observer& observer) noexcept {
        if constexpr (kEffects.has(Effect::medium))
            return trace_volume_path<kEffects>(scene_, plan_, draws_, stats_.rays, observer);
        else
            return trace_path<kEffects>(scene_, plan_.integrator, draws_, stats_.rays, observer);
    }

    const Scene& scene_;
    const RenderPlan& plan_;
    Draws draws_;
    std::uint64_t block_ = 0;
};

}  // namespace koksma::detail
