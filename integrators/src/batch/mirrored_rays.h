// Rays that perfect mirrors and glass send on from a camera's rays are as alike as those were: in packets of their own they are traced
// as coherent, which among rays that diffuse surfaces scatter would be dear.

KOKSMA_MATHS_BEGIN

/// The paths of a group, by what sent on their rays.
/// @tparam kGroup  most paths at a time
template <EffectSet kEffects, std::size_t kGroup>
class MirroredRays {
    static constexpr std::size_t kPack = static_cast<std::size_t>(kLanes);

public:
    /// Paths whose rays are traced together.
    struct Rays {
        Coherence coherence = Coherence::incoherent;
        std::size_t count = 0;
        alignas(64) std::int32_t place[kGroup + kPack]{};  ///< in the queue; in lanes beyond the last, too
    };

    /// Sorts the paths from first to end. What a ray meets depends on its kind alone, not on which others the group has.
    /// @return  false: no ray was mirrored or refracted, all may stay as they are
    [[nodiscard]] bool sort(const detail::PathQueue& q, std::size_t first, std::size_t end) {
        for (Rays& r : rays_) r.count = 0;
        for (std::size_t at = first; at < end; at += kPack) {
            const Mask active = Mask::first(end - at), delta = active & (Int32::load(q.delta + at) != Int32(0));
            Mask refracted{};
            if constexpr (kEffects.has(Effect::dielectric)) refracted = delta & (Float::load(q.eta_scale + at) != Float(1.0f));
            const Int32 place = iota(static_cast<std::int32_t>(at));
            add(rays_[0], refracted, place);
            add(rays_[1], delta & !refracted, place);
            add(rays_[2], active & !delta, place);
        }
        for (Rays& r : rays_) Int32(static_cast<std::int32_t>(first)).store_any(r.place + r.count);
        return rays_[2].count < end - first;
    }
    [[nodiscard]] const std::array<Rays, 3>& rays() const { return rays_; }

private:
    static void add(Rays& to, Mask which, Int32 place) { to.count += place.compress_store(which, to.place + to.count); }

    std::array<Rays, 3> rays_{Rays{Coherence::coherent}, Rays{Coherence::coherent}, Rays{Coherence::incoherent}};
};

KOKSMA_MATHS_END
