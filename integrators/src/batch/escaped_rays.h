// The rays of a few packs that met nothing: they wait for each other, and ask the environment together.

KOKSMA_MATHS_BEGIN

class EscapedRays {
    static constexpr std::size_t kPack = static_cast<std::size_t>(kLanes);

public:
    explicit EscapedRays(const Scene& scene) : scene_(scene), queue_(std::make_unique<detail::EscapeQueue>()) {}

    /// @param delta        lanes whose direction light sampling could not have made
    /// @param pdf          of the direction, per steradian
    /// @param probability  with which the environment would have been chosen
    void queue(Mask escaped, const Vec3<Float>& d, const Vec3<Float>& beta, Mask delta, Float pdf, Float probability, Int32 slot) {
        detail::EscapeQueue& q = *queue_;
        compress_store(d, escaped, q.d, count_);
        compress_store(beta, escaped, q.beta, count_);
        select(delta, Float(-1.0f), pdf).compress_store(escaped, q.pdf + count_);
        probability.compress_store(escaped, q.probability + count_);
        count_ += slot.compress_store(escaped, q.slot + count_);
    }

    /// Adds what they bring: first all places in the map, so that it is there when it is read. None is left.
    void add(PathSums& sums) {
        const detail::EscapeQueue& q = *queue_;
        const bool mapped = scene_.environment_map.has_value();
        const EnvironmentTable table = mapped ? scene_.environment_map->table() : EnvironmentTable{};
        if (mapped) find_places(table);
        for (std::size_t at = 0; at < count_; at += kPack) {
            const Float pdf = Float::load(q.pdf + at);
            const Mask active = Mask::first(count_ - at), delta = pdf < Float(0.0f);
            Vec3<Float> radiance;
            Float pdf_light(0.25f * kInvPi);
            if (mapped) {
                // Lanes beyond the last hold old places or zeros: the map has them.
                const EnvironmentPlaceOf<Float> place{Int32::load(q.column + at), Int32::load(q.row + at), Float::load(q.d.x + at),
                                                      Float::load(q.d.y + at)};
                radiance = environment_radiance(table, place);
                if (any(active & !delta)) pdf_light = environment_density(table, place);
            } else {
                radiance = Vec3<Float>::splat(scene_.lights[static_cast<std::size_t>(scene_.environment_light)].radiance.constant);
            }
            const Float weight = select(delta, Float(1.0f), power_heuristic(pdf, pdf_light * Float::load(q.probability + at)));
            const VectorLanes contribution(load(q.beta, at) * radiance * weight);
            for_lanes(active, [&](int i) { sums.add(q.slot[at + static_cast<std::size_t>(i)], contribution[i]); });
        }
        count_ = 0;
    }

private:
    void find_places(const EnvironmentTable& table) {
        detail::EscapeQueue& q = *queue_;
        for (std::size_t at = 0; at < count_; at += kPack) {
            const EnvironmentPlaceOf<Float> place = environment_place(table, load(q.d, at));
            place.x.store(q.d.x + at);
            place.y.store(q.d.y + at);
            place.column.store(q.column + at);
            place.row.store(q.row + at);
            const Mask active = Mask::first(count_ - at);
            const Int32 cell = place.row * Int32(table.width + 1) + place.column;
            prefetch(table.texels, active, cell);
            prefetch(table.texels + table.width + 1, active, cell);
            prefetch(table.begin, active & !(Float::load(q.pdf + at) < Float(0.0f)), cell);
        }
    }

    const Scene& scene_;
    std::unique_ptr<detail::EscapeQueue> queue_;
    std::size_t count_ = 0;
};

KOKSMA_MATHS_END
