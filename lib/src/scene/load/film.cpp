// <film>: its size, its crop and its reconstruction filter.

#include "fail.h"
#include "sensor.h"

#include <koksma/scene/film_filter.h>

namespace koksma::loader {
namespace {

constexpr std::int64_t kMaxSide = 1 << 20;  // keeps width * height * channels far from 2^63

std::int32_t read_side(Properties& p, const std::string& name, std::int64_t default_value, std::int64_t lowest) {
    return static_cast<std::int32_t>(p.integer(name, default_value, lowest, kMaxSide));
}

/// Without one a gaussian, as in Mitsuba. Filters with negative lobes have no samples of weight one.
ReconstructionFilter read_filter(Properties& p, const Context& context) {
    using Kind = ReconstructionFilter::Kind;
    ReconstructionFilter filter;
    filter.kind = Kind::gaussian;
    filter.beyond_film = p.boolean("sample_border", false);
    const Element* element = p.object("rfilter");
    if (!element) return filter;
    Properties f(*element, context.ids, {"box", "tent", "gaussian"});
    const auto positive = [&](const std::string& name, double default_value, double largest) {
        const double v = f.number(name, default_value);
        if (!(v > 0.0 && v <= largest)) fail(f.where(name), "'{}' is {}; it must be in (0, {}]", name, v, largest);
        return v;
    };
    if (f.type() == "gaussian") {
        filter.stddev = positive("stddev", 0.5, kLargestFilterRadius / 4.0);
    } else {
        filter.kind = f.type() == "tent" ? Kind::tent : Kind::box;
        filter.radius = positive("radius", filter.kind == Kind::tent ? 1.0 : 0.5, kLargestFilterRadius);
    }
    f.finish();
    return filter;
}

void read_crop(Properties& p, FilmSettings& film) {
    bool cropped = false;
    for (const char* name : {"crop_offset_x", "crop_offset_y", "crop_width", "crop_height"}) cropped = cropped || p.has(name);
    film.crop_x = read_side(p, "crop_offset_x", 0, 0);
    film.crop_y = read_side(p, "crop_offset_y", 0, 0);
    film.crop_width = read_side(p, "crop_width", film.width, 1);
    film.crop_height = read_side(p, "crop_height", film.height, 1);
    if (film.crop_x + film.crop_width > film.width || film.crop_y + film.crop_height > film.height)
        fail(p.where(), "the crop of {} x {} at ({}, {}) reaches out of the film of {} x {}", film.crop_width, film.crop_height,
             film.crop_x, film.crop_y, film.width, film.height);
    if (!cropped) film.crop_width = film.crop_height = 0;
}

}  // namespace

void read_film(const Element& element, Context& context) {
    Properties p(element, context.ids, {"hdrfilm"});
    FilmSettings& film = context.scene.film;
    film.width = read_side(p, "width", film.width, 1);
    film.height = read_side(p, "height", film.height, 1);
    read_crop(p, film);
    // What concerns only the file that Mitsuba would write:
    (void)p.choice("pixel_format", "rgb", {"rgb", "rgba"});
    (void)p.choice("component_format", "float16", {"float16", "float32", "uint32"});
    (void)p.choice("file_format", "openexr", {"openexr", "exr", "rgbe", "pfm"});
    (void)p.boolean("compensate", false);  // our sums are compensated anyway
    film.filter = read_filter(p, context);
    p.finish();
}

}  // namespace koksma::loader
