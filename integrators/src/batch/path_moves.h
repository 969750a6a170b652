// Paths of the queue that move together, into places that others left.

KOKSMA_MATHS_BEGIN

inline void move_row(Mask which, detail::FloatRow& row, std::size_t at, std::size_t to) { Float::load(row + at).compress_store(which, row + to); }
inline void move_row(Mask which, detail::IntRow& row, std::size_t at, std::size_t to) { Int32::load(row + at).compress_store(which, row + to); }

/// Moves a pack of paths whose rays have been traced behind those before.
/// @param to              where these end; not beyond `at`
/// @param surfaces_shine  some surface of the scene emits: those ask how they were met
/// @return  where the paths that have moved end
template <EffectSet kEffects>
[[nodiscard]] std::size_t move_together(detail::PathQueue& q, detail::Met& met, Mask which, std::size_t at, std::size_t to, [[maybe_unused]] bool surfaces_shine) {
    const auto n = static_cast<std::size_t>(count(which));
    const bool first_lanes = lane_bits(which) == (std::uint32_t{1} << n) - 1u;
    if (to == at && first_lanes) return to + n;  // they are there
    const auto move = [&](auto&... rows) { (move_row(which, rows, at, to), ...); };
    move(q.o.x, q.o.y, q.o.z, q.d.x, q.d.y, q.d.z, q.beta.x, q.beta.y, q.beta.z, q.slot, met.geometry, met.primitive);
    if constexpr (kEffects.has(Effect::area_light))
        if (surfaces_shine) {
            move(q.pdf, q.delta, q.last_p.x, q.last_p.y, q.last_p.z);
            if constexpr (kEffects.has(Effect::many_lights)) move(q.last_n.x, q.last_n.y, q.last_n.z);
        }
    if constexpr (kEffects.has(Effect::instancing)) move(met.instance);
    if constexpr (kEffects.has(Effect::motion)) move(q.time);
    if constexpr (kEffects.has(Effect::dielectric)) move(q.eta_scale);
    if constexpr (kEffects.has(Effect::roulette)) move(q.lossless);
    for_lanes(which, [&](int i) { q.id[to++] = q.id[at + static_cast<std::size_t>(i)]; });
    return to;
}

KOKSMA_MATHS_END
