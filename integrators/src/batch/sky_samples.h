// Light samples of an environment map that is a scene's only light. They depend on no point, so a group's are drawn before its first
// pack is shaded, in full packs of those paths that will ask: the map's tables, which tracing has driven out of the cache, are waited
// for once and not in the midst of every pack.

KOKSMA_MATHS_BEGIN

/// @tparam kGroup  most paths at a time
template <EffectSet kEffects, std::size_t kGroup>
class SkySamples {
    static constexpr std::size_t kPack = static_cast<std::size_t>(kLanes);

public:
    explicit SkySamples(const Scene& scene) : scene_(scene) {
        usable_ = kEffects.has(Effect::environment) && scene.lights.size() == 1 && scene.light_tree.empty() && scene.environment_map &&
                  !scene.environment_map->is_black();
        if (!usable_) return;
        const auto smooth = [&](std::uint32_t side) {
            koksma::BsdfOf<float> b;
            b.kind = scene.sides[side].kind;
            return koksma::has_smooth_lobe(b);
        };
        for (const GeometryRecord& g : scene.geometries) {
            const MaterialSides& m = scene.materials[g.material];
            asks_.push_back(smooth(m.front) || (m.two_sided && smooth(m.back)) ? 1 : 0);
        }
    }
    [[nodiscard]] bool usable() const { return usable_; }

    /// @param at        place in the group of the pack's first path
    /// @param geometry  that the paths met
    /// @param u         the slot of the light's position
    void want(std::size_t at, Mask active, Int32 geometry, const Vec2<Float>& u) {
        const Mask asks = active & (gather(asks_.data(), select(active, geometry, Int32(0))) != Int32(0));
        u.x.compress_store(asks, x_ + count_);
        u.y.compress_store(asks, y_ + count_);
        count_ += (iota(static_cast<std::int32_t>(at))).compress_store(asks, path_ + count_);
    }

    /// Draws the directions of all that are wanted. Their places in the map are on their way to the cache from now on.
    void find() {
        const EnvironmentTable table = scene_.environment_map->table();
        const EnvironmentCells cells = scene_.environment_map->cells();
        for (std::size_t at = 0; at < count_; at += kPack) {
            // Lanes beyond the last hold old numbers or zeros: any will do.
            const Vec3<Float> wi = environment_direction(cells, Vec2<Float>{Float::load(x_ + at), Float::load(y_ + at)});
            store(wi, direction_, at);
            places_.find(table, at, Mask::first(count_ - at), wi);
        }
    }
    /// What comes from there. @pre  find()
    void draw() {
        const EnvironmentTable table = scene_.environment_map->table();
        for (std::size_t at = 0; at < count_; at += kPack) {
            const EnvironmentValueOf<Float> value = environment_at(table, places_.get(at));
            const VectorLanes radiance(value.radiance);
            const NumberLanes pdf(value.pdf_w);
            for (std::size_t i = 0; i < kPack && at + i < count_; ++i) {
                const auto path = static_cast<std::size_t>(path_[at + i]);
                const Vec3f wi{direction_.x[at + i], direction_.y[at + i], direction_.z[at + i]}, l = radiance[static_cast<int>(i)];
                put(wi_, path, wi);
                put(radiance_, path, l);
                pdf_[path] = pdf.x[i];
            }
        }
        count_ = 0;
    }

    /// Those of a pack. @return  anything in lanes that do not ask
    [[nodiscard]] LightSamplePack get(std::size_t at) const {
        const Vec3<Float> wi = load(wi_, at);
        return {wi, load(radiance_, at), wi, Float::load(pdf_ + at), Mask{}, Mask::first(kPack)};
    }

private:
    static constexpr std::size_t kRow = kGroup + kPack;
    using Rows = detail::VectorRowsOf<kRow>;
    static void put(Rows& rows, std::size_t at, Vec3f v) {
        rows.x[at] = v.x;
        rows.y[at] = v.y;
        rows.z[at] = v.z;
    }

    const Scene& scene_;
    bool usable_ = false;
    std::vector<std::int32_t> asks_;  ///< by geometry: 1 where a side of its material has a smooth lobe
    // Those that ask, close together:
    alignas(64) float x_[kRow]{}, y_[kRow]{};
    alignas(64) std::int32_t path_[kRow]{};
    Rows direction_{};
    SkyPlaces<kGroup> places_;
    std::size_t count_ = 0;
    // By the path's place in the group:
    Rows wi_{}, radiance_{};
    alignas(64) float pdf_[kRow]{};
};

KOKSMA_MATHS_END
