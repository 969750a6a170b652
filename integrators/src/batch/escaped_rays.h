// The rays of a few packs that met nothing: they wait for each other, and ask the environment together.

KOKSMA_MATHS_BEGIN

/// @tparam kGroup  most paths at a time
template <std::size_t kGroup>
class EscapedRays {
    static constexpr std::size_t kPack = static_cast<std::size_t>(kLanes);

public:
    explicit EscapedRays(const Scene& scene) : scene_(scene) {}

    /// @param delta        lanes whose direction light sampling could not have made
    /// @param pdf          of the direction, per steradian
    /// @param probability  with which the environment would have been chosen
    void queue(Mask escaped, const Vec3<Float>& d, const Vec3<Float>& beta, Mask delta, Float pdf, Float probability, Int32 slot) {
        compress_store(d, escaped, d_, count_);
        compress_store(beta, escaped, beta_, count_);
        select(delta, Float(-1.0f), pdf).compress_store(escaped, pdf_ + count_);
        probability.compress_store(escaped, probability_ + count_);
        count_ += slot.compress_store(escaped, slot_ + count_);
    }

    /// Finds their places in the map, which are on their way to the cache from now on.
    void find() {
        if (!scene_.environment_map) return;
        const EnvironmentTable table = scene_.environment_map->table();
        for (std::size_t at = 0; at < count_; at += kPack) places_.find(table, at, Mask::first(count_ - at), load(d_, at));
    }

    /// Adds what they bring. None is left. @pre  find() since the last queue()
    void add(PathSums& sums) {
        const bool mapped = scene_.environment_map.has_value();
        const EnvironmentTable table = mapped ? scene_.environment_map->table() : EnvironmentTable{};
        for (std::size_t at = 0; at < count_; at += kPack) {
            const Float pdf = Float::load(pdf_ + at);
            const Mask active = Mask::first(count_ - at), delta = pdf < Float(0.0f);
            Vec3<Float> radiance;
            Float pdf_light(0.25f * kInvPi);
            if (mapped) {
                const EnvironmentValueOf<Float> value = environment_at(table, places_.get(at));
                radiance = value.radiance;
                pdf_light = value.pdf_w;
            } else {
                radiance = Vec3<Float>::splat(scene_.lights[static_cast<std::size_t>(scene_.environment_light)].radiance.constant);
            }
            const Float weight = select(delta, Float(1.0f), power_heuristic(pdf, pdf_light * Float::load(probability_ + at)));
            const VectorLanes contribution(load(beta_, at) * radiance * weight);
            for_lanes(active, [&](int i) { sums.add(slot_[at + static_cast<std::size_t>(i)], contribution[i]); });
        }
        count_ = 0;
    }

private:
    static constexpr std::size_t kRow = kGroup + kPack;
    const Scene& scene_;
    SkyPlaces<kGroup> places_;
    detail::VectorRowsOf<kRow> d_{}, beta_{};
    alignas(64) float pdf_[kRow]{}, probability_[kRow]{};
    alignas(64) std::int32_t slot_[kRow]{};
    std::size_t count_ = 0;
};

KOKSMA_MATHS_END
