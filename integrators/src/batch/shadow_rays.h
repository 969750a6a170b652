// The shadow rays of one bounce: they wait until all paths have taken it, and are traced together.

KOKSMA_MATHS_BEGIN

template <EffectSet kEffects>
class ShadowRays {
    static constexpr bool kMotion = kEffects.has(Effect::motion);
    static constexpr std::size_t kPack = static_cast<std::size_t>(kLanes);

public:
    explicit ShadowRays(const Scene& scene) : scene_(scene), queue_(std::make_unique<detail::ShadowQueue>()) {
        for (std::uint32_t& m : packet_.mask) m = ~0u;
    }

    /// @param active        lanes whose rays Embree may see
    /// @param d, t_far      towards a point: to it, and 1; towards a direction: infinity
    /// @param contribution  what the light brings if nothing is in the way
    void queue(Mask active, const Vec3<Float>& o, const Vec3<Float>& d, Float t_far, [[maybe_unused]] Float time, const Vec3<Float>& contribution, Int32 slot) {
        detail::ShadowQueue& q = *queue_;
        compress_store(o, active, q.o, count_);
        compress_store(d, active, q.d, count_);
        compress_store(contribution, active, q.contribution, count_);
        if constexpr (kMotion) time.compress_store(active, q.time + count_);
        t_far.compress_store(active, q.t_far + count_);
        count_ += slot.compress_store(active, q.slot + count_);
    }

    /// @param order  to trace them in; null: as they came. What they meet does not depend on it.
    /// @return  how many there were; none is left
    std::size_t trace(RayOrder* order, PathSums& sums) {
        const detail::ShadowQueue& q = *queue_;
        if (order != nullptr) order->sort(q.o, q.d, count_);
        for (std::size_t at = 0; at < count_; at += kPack) {
            const Mask active = Mask::first(count_ - at);
            alignas(4 * kLanes) IntLanes places;
            const Int32 place = order != nullptr ? order->place(at) : iota(static_cast<std::int32_t>(at));
            place.store(places);
            const Mask visible = active & !occluded(active, place, at, order != nullptr);
            for_lanes(visible, [&](int i) {
                const auto ray = static_cast<std::size_t>(places[i]);
                sums.add(q.slot[ray], {q.contribution.x[ray], q.contribution.y[ray], q.contribution.z[ray]});
            });
            if (sums.hashes.empty()) continue;
            const std::uint32_t seen = lane_bits(visible);
            for_lanes(active, [&](int i) { sums.hash(q.slot[places[i]], (seen >> i) & 1u); });
        }
        return std::exchange(count_, 0);
    }

private:
    [[nodiscard]] Mask occluded(Mask active, Int32 place, std::size_t first, bool sorted) {
        const detail::ShadowQueue& q = *queue_;
        const auto row = [&](const float* numbers) { return sorted ? gather(numbers, place) : Float::load(numbers + first); };
        row(q.o.x).store(packet_.o_x);
        row(q.o.y).store(packet_.o_y);
        row(q.o.z).store(packet_.o_z);
        row(q.d.x).store(packet_.d_x);
        row(q.d.y).store(packet_.d_y);
        row(q.d.z).store(packet_.d_z);
        Float(0.0f).store(packet_.t_near);
        if constexpr (kMotion) row(q.time).store(packet_.time);
        row(q.t_far).store(packet_.t_far);
        select(active, Int32(-1), Int32(0)).store(valid_);
        // Unsorted as incoherent, also from camera hits: 0.63 to 0.99 of the time.
        scene_.accelerator.occluded(packet_, valid_, sorted ? Coherence::coherent : Coherence::incoherent);
        return Float::load(packet_.t_far) < Float(0.0f);
    }

    const Scene& scene_;
    std::unique_ptr<detail::ShadowQueue> queue_;
    RayPacket<kLanes> packet_{};
    alignas(4 * kLanes) IntLanes valid_{};
    std::size_t count_ = 0;
};

KOKSMA_MATHS_END
