#pragma once
// Points of samplers that lay one sequence over the image: all samples of a rectangle of pixels.

#include "draw.h"

namespace koksma::test {

/// A film and what is drawn of it; `film_slot` makes the first pair the position on the film.
struct FilmDraw {
    std::int32_t width = 8, height = 8;
    std::uint64_t spp = 1, seed = 0, first = 0;
    std::uint32_t pairs = 2;
    bool film_slot = false;
    std::int32_t x0 = 0, y0 = 0, columns = 0, rows = 0;  ///< the rectangle; 0 columns: the whole film
};

[[nodiscard]] inline DimensionLayout film_layout(std::uint32_t pairs, bool film_slot) {
    DimensionLayout layout;
    if (film_slot) layout.add_camera(SlotRole::film, 2);
    for (std::uint32_t i = film_slot ? 1 : 0; i < pairs; ++i) {
        layout.begin_bounce();
        layout.add_bounce(SlotRole::direction, 2);
    }
    return layout;
}

/// value(d, (y * columns + x) * spp + i)
[[nodiscard]] inline Points draw_film(const SamplerFactory& factory, const FilmDraw& f) {
    const SamplingPlan plan{.film_width = f.width, .film_height = f.height, .spp = f.spp, .seed = f.seed, .layout = film_layout(f.pairs, f.film_slot)};
    std::vector<SampleId> ids;
    const std::int32_t columns = f.columns > 0 ? f.columns : f.width, rows = f.columns > 0 ? f.rows : f.height;
    for (std::int32_t y = 0; y < rows; ++y)
        for (std::int32_t x = 0; x < columns; ++x)
            for (std::uint64_t i = 0; i < f.spp; ++i) ids.push_back({{f.x0 + x, f.y0 + y}, f.first + i});
    Points p{ids.size(), std::vector<float>(std::size_t{2} * f.pairs * ids.size())};
    factory.bind(plan)->fill(ids, plan.layout.slots(), p.values.data(), ids.size());
    return p;
}

template <class S>
[[nodiscard]] Points draw_film(std::string_view spec, const FilmDraw& f) {
    Registry registry;
    registry.add<S>();
    return draw_film(*registry.make(spec), f);
}

/// Whether the points of samples [first, first + 2^m) are a (0, m, 2)-net in dimensions d, d + 1.
[[nodiscard]] inline bool is_net(const Points& p, std::size_t d, std::size_t first, int m) {
    for (int k = 0; k <= m; ++k) {
        std::vector<int> hits(std::size_t{1} << m, 0);
        for (std::size_t i = first; i < first + (std::size_t{1} << m); ++i)
            if (hits[((p.bits24(d, i) >> (24 - k)) << (m - k)) | (p.bits24(d + 1, i) >> (24 - (m - k)))]++) return false;
    }
    return true;
}

}  // namespace koksma::test
