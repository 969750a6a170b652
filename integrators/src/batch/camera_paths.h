// Paths begin: camera rays in packs.

KOKSMA_MATHS_BEGIN

/// As koksma::film_point, of the first samples. @param u  anything in lanes without a sample
[[nodiscard]] inline Vec2<Float> film_points(const CompiledCamera& c, std::span<const SampleId> ids, const Vec2<Float>& u) {
    constexpr auto kPack = static_cast<std::size_t>(kLanes);
    if (c.filter.is_pixel()) {
        alignas(4 * kLanes) IntLanes x{}, y{};
        for (std::size_t i = 0; i < kPack && i < ids.size(); ++i) {
            x[i] = ids[i].pixel.x;
            y[i] = ids[i].pixel.y;
        }
        const auto along = [](Int32 pixel, Float offset_in_pixel, double width, double offset, double half) {
            const Double f = (Double::of(pixel) + Double::of(offset_in_pixel)) * Double::of(width) + Double::of(offset);
            return ((Double::of(1.0) - Double::of(2.0) * f) * Double::of(half)).rounded();
        };
        return {along(Int32::load(x), u.x, c.pixel_width, c.offset_x, c.half_width), along(Int32::load(y), u.y, c.pixel_height, c.offset_y, c.half_height)};
    }
    NumberLanes x(u.x), y(u.y);
    for (std::size_t i = 0; i < kPack && i < ids.size(); ++i) {
        const Vec2f film = film_point(c, ids[i].pixel.x, ids[i].pixel.y, {x.x[i], y.x[i]});
        x.x[i] = film.x;
        y.x[i] = film.y;
    }
    return {x.pack(), y.pack()};
}

/// @param numbers  filled for the camera
/// @param q        gets a path for each sample
template <EffectSet kEffects>
void start_paths(const CompiledCamera& camera, const BatchNumbers& numbers, std::span<const SampleId> ids, detail::PathQueue& q) {
    constexpr auto kPack = static_cast<std::size_t>(kLanes);
    for (std::size_t at = 0; at < ids.size(); at += kPack) {
        const Vec2<Float> film = film_points(camera, ids.subspan(at), numbers.film(at));
        for (std::size_t i = at; i < at + kPack && i < ids.size(); ++i) q.id[i] = ids[i];
        Vec2<Float> u_lens{};
        if constexpr (kEffects.has(Effect::lens)) u_lens = numbers.lens(at);
        const CameraRayOf<Float> ray = camera_ray(camera, film, u_lens);
        store(ray.o, q.o, at);
        store(ray.d, q.d, at);
        ray.t_near.store(q.t_near + at);
        ray.t_far.store(q.t_far + at);
        store(Vec3<Float>(Float(1.0f)), q.beta, at);
        if constexpr (kEffects.has(Effect::motion)) numbers.time(at).store(q.time + at);
        if constexpr (kEffects.has(Effect::dielectric)) Float(1.0f).store(q.eta_scale + at);
        Float(0.0f).store(q.pdf + at);
        Int32(-1).store(q.delta + at);
        if constexpr (kEffects.has(Effect::roulette)) Int32(0).store(q.lossless + at);
        if constexpr (kEffects.has(Effect::area_light) || kEffects.has(Effect::many_lights)) store(Vec3<Float>(Float(0.0f)), q.last_p, at);
        if constexpr (kEffects.has(Effect::many_lights)) store(Vec3<Float>{Float(0.0f), Float(0.0f), Float(1.0f)}, q.last_n, at);
        iota(static_cast<std::int32_t>(at)).store(q.slot + at);
    }
}

KOKSMA_MATHS_END
