#include "points.h"

#include "data_file.h"
#include "npy.h"

#include <algorithm>
#include <charconv>
#include <cmath>

namespace koksma {
namespace {

constexpr std::size_t kMostPoints = std::size_t{1} << 31;  // what `permute` takes

/// @param where  file, or file and line
std::uint32_t fraction(double u, const std::string& where) {
    if (!(u >= 0 && u < 1)) throw Error(where + ": the coordinate " + std::to_string(u) + " is not in [0, 1)");
    return static_cast<std::uint32_t>(u * 0x1p32);
}

PointSets parse_text(std::string_view bytes, const std::string& file) {
    PointSets sets;
    std::size_t points = 0;  // of the set that is being read
    Lines lines(bytes);
    const auto here = [&] { return file + ":" + std::to_string(lines.number()); };
    const auto end_set = [&] {
        if (points == 0) return;
        if (sets.sets != 0 && points != sets.points)
            throw Error(here() + ": set " + std::to_string(sets.sets) + " ends here with " + std::to_string(points) + " points; those before it have " + std::to_string(sets.points));
        sets.points = points;
        ++sets.sets;
        points = 0;
    };
    for (std::string_view line; lines.next(line);) {
        const bool comment = line.find('#') != std::string_view::npos;
        line = line.substr(0, line.find('#'));
        std::size_t d = 0;
        for (std::string_view word = next_word(line); !word.empty(); word = next_word(line), ++d) {
            double u = 0;
            const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), u);
            if (error != std::errc{} || end != word.data() + word.size()) throw Error(here() + ": '" + std::string(word) + "' is not a number");
            sets.values.push_back(fraction(u, here()));
        }
        if (d == 0) {
            if (!comment) end_set();
            continue;
        }
        if (sets.dimensions != 0 && d != sets.dimensions)
            throw Error(here() + ": has " + std::to_string(d) + " coordinates; the points before it have " + std::to_string(sets.dimensions));
        sets.dimensions = d;
        ++points;
    }
    end_set();
    if (sets.sets == 0) throw Error(file + ": has no points");
    return sets;
}

PointSets from_npy(const NpyArray& array, const std::string& file) {
    const std::vector<std::size_t>& s = array.shape;
    PointSets sets;
    if (s.size() == 2)
        sets = {.sets = 1, .points = s[0], .dimensions = s[1]};
    else if (s.size() == 3)
        sets = {.sets = s[0], .points = s[1], .dimensions = s[2]};
    else if (s.size() == 4)
        sets = {.sets = s[0] * s[1], .points = s[2], .dimensions = s[3], .tile_width = s[1], .tile_height = s[0]};
    else
        throw Error(file + ": its array has " + std::to_string(s.size()) + " dimension(s); (N, D), (K, N, D) and (H, W, N, D) are read");
    sets.values.reserve(array.values.size());
    for (const double u : array.values) sets.values.push_back(fraction(u, file + ", number " + std::to_string(sets.values.size())));
    return sets;
}

}  // namespace

PointSets PointSets::parse(std::string_view bytes, const std::string& file) {
    PointSets sets = is_npy(bytes) || file.ends_with(".npy") ? from_npy(parse_npy(bytes, file), file) : parse_text(bytes, file);
    if (sets.points > kMostPoints) throw Error(file + ": has " + std::to_string(sets.points) + " points a set; " + std::to_string(kMostPoints) + " are possible");
    return sets;
}

PointSets PointSets::built_in() {
    // 1/g and 1/g^2 times 2^64, g^3 = g + 1: the leading 32 digits of multiples are exact.
    constexpr std::uint64_t kStep[2] = {0xc13fa9a902a6328full, 0x91e10da5c79e7b1cull};
    PointSets sets{.sets = 1, .points = 4096, .dimensions = 2};
    for (std::uint64_t i = 0; i < sets.points; ++i)
        for (const std::uint64_t step : kStep) sets.values.push_back(static_cast<std::uint32_t>((0x8000000000000000ull + i * step) >> 32));
    return sets;
}

PointsSampler::Tables::Tables(const SamplerOptions& options) : file_(options["file"]), pad_(options["pad"]) {
    if (file_ == kBuiltInFile) {
        check_no_checksum(options);
        sets_ = PointSets::built_in();
        return;
    }
    const std::string bytes = read_data_file(file_);
    checksum_ = checksum_of(bytes);
    check_checksum(options, file_, checksum_);
    sets_ = PointSets::parse(bytes, file_);
}

void PointsSampler::Tables::describe(SamplerInfo& info) const {
    info.max_samples = sets_.points;
    describe_padding(pad_, static_cast<std::uint32_t>(sets_.dimensions), info);
    if (sets_.is_tile()) info.scope = SamplerScope::tile;
    info.remark = (file_ == kBuiltInFile ? "built-in R2 points" : file_ + ", checksum " + checksum_) + ": " + std::to_string(sets_.points) + " points in " +
                  std::to_string(sets_.dimensions) + " dimensions, " +
                  (sets_.is_tile() ? "a tile of " + std::to_string(sets_.tile_width) + " x " + std::to_string(sets_.tile_height) + " pixels"
                                   : std::to_string(sets_.sets) + " set(s)");
}

std::size_t PointsSampler::set_of(Pixel pixel, Key key) const noexcept {
    if (sets_->is_tile()) {
        const auto within = [](std::int32_t x, std::size_t n) {
            const auto size = static_cast<std::int64_t>(n), r = x % size;
            return static_cast<std::size_t>(r < 0 ? r + size : r);
        };
        return within(pixel.y, sets_->tile_height) * sets_->tile_width + within(pixel.x, sets_->tile_width);
    }
    if (!any_set_) return fixed_set_;
    return static_cast<std::size_t>((std::uint64_t{keyed_hash(derive_key(key, 0x736574ull), 0)} * sets_->sets) >> 32);
}

SamplerInfo PointsSampler::info() {
    return {.name = "points",
            .title = "Points of a file",
            .paper = "Cranley and Patterson 1976, Randomization of number theoretic methods for multiple integration",
            .options = {{.name = "randomize",
                         .default_value = "cp",
                         .values = {"none", "cp"},
                         .help = "as they are (of K sets, the one that the seed numbers), shift modulo 1 per pixel and dimension; of a tile, per dimension",
                         .always_shown = true},
                        {.name = "file", .default_value = kBuiltInFile, .values = {}, .help = "text or .npy of shape (N, D), (K, N, D) or (H, W, N, D)"},
                        pad_option("2"),
                        {.name = "set", .default_value = "any", .values = {}, .help = "of K sets, the number of the one to use; any: see randomize"},
                        checksum_option(),
                        pixels_option()},
            .kind = SamplerKind::set,
            .joint = 2,
            .remark = "dimensions and samples are those of the file"};
}

PointsSampler::PointsSampler(const SamplerOptions& options, const SamplingPlan& plan, const Tables& tables)
    : keys_(options, plan, 0x706f696e7473ull),
      film_key_(pixel_key(~plan.seed ^ 0x706f696e7473ull, {})),
      sets_(&tables.sets()),
      places_(padded_places(options, plan.layout, static_cast<std::uint32_t>(sets_->dimensions))),
      count_(static_cast<std::uint32_t>(std::clamp<std::uint64_t>(plan.spp, 1, sets_->points))),
      shifted_(options["randomize"] == "cp") {
    const std::string& set = options["set"];
    const std::string who = "sampler '" + options.canonical() + "'", has = " has " + std::to_string(sets_->sets) + " point set(s), numbered from 0";
    if (set != "any") {
        if (sets_->is_tile()) throw Error(who + ": set= is given, but the file is a tile: the pixel chooses");
        const auto [end, error] = std::from_chars(set.data(), set.data() + set.size(), fixed_set_);
        if (error != std::errc{} || end != set.data() + set.size() || fixed_set_ >= sets_->sets) throw Error(who + has + "; set=" + set + " is not one of them");
        return;
    }
    any_set_ = shifted_ && sets_->sets > 1;
    if (!shifted_ && !sets_->is_tile() && sets_->sets > 1) {
        if (plan.seed >= sets_->sets)
            throw Error(who + has + ", and no randomisation: seed " + std::to_string(plan.seed) + " is beyond them (randomize=cp makes any number of replicates; set=K takes one set for all seeds)");
        fixed_set_ = static_cast<std::size_t>(plan.seed);
    }
}

}  // namespace koksma
