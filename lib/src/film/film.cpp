#include <koksma/film/film.h>
#include <koksma/sampling/error.h>

#include <cmath>

namespace koksma {

const char* name(InvalidSample::Kind kind) noexcept {
    switch (kind) {
        case InvalidSample::Kind::nan: return "NaN";
        case InvalidSample::Kind::infinite: return "infinite";
        case InvalidSample::Kind::negative: break;
    }
    return "negative";
}

bool is_invalid(Vec3f radiance, InvalidSample::Kind& kind) noexcept {
    const float v[3] = {radiance.x, radiance.y, radiance.z};
    bool bad = false;
    for (const float c : v) {
        if (c >= 0.0f && std::isfinite(c)) continue;
        bad = true;
        kind = std::isnan(c) ? InvalidSample::Kind::nan : (std::isinf(c) ? InvalidSample::Kind::infinite : InvalidSample::Kind::negative);
        if (kind == InvalidSample::Kind::nan) break;
    }
    return bad;
}

Vec3d xyz_of(Vec3d c) noexcept {
    return {0.412453 * c.x + 0.357580 * c.y + 0.180423 * c.z, 0.212671 * c.x + 0.715160 * c.y + 0.072169 * c.z,
            0.019334 * c.x + 0.119193 * c.y + 0.950227 * c.z};
}

/// The exact error of a sum is a double too, and is kept.
/// Source: Knuth 1998, The Art of Computer Programming 2, section 4.2.2, theorem B (TwoSum)
void Film::Sum::add(Vec3d v) noexcept {
    const Vec3d s = high + v;
    const Vec3d part = s - high;
    low += (high - (s - part)) + (v - part);
    high = s;
}

void Film::add(Pixel pixel, std::span<const Vec3f> radiance) noexcept {
    Vec3d sum;
    for (const Vec3f& r : radiance) sum += to_double(r);
    sums_[index(pixel)].add(sum);
    counts_[index(pixel)] += radiance.size();
    if (squares_.empty()) return;
    Vec3d squares;
    for (const Vec3f& r : radiance) {
        const Vec3d xyz = xyz_of(to_double(r));
        squares += xyz * xyz;
    }
    squares_[index(pixel)].add(squares);
}

void Film::merge(const Film& later) {
    if (rect_.x != later.rect_.x || rect_.y != later.rect_.y || rect_.width != later.rect_.width || rect_.height != later.rect_.height)
        throw Error("films of different rectangles cannot be merged");
    if (has_moments() != later.has_moments()) throw Error("films with and without moments cannot be merged");
    for (std::size_t i = 0; i < sums_.size(); ++i) {
        sums_[i].add(later.sums_[i].high);
        sums_[i].low += later.sums_[i].low;
        counts_[i] += later.counts_[i];
        if (squares_.empty()) continue;
        squares_[i].add(later.squares_[i].high);
        squares_[i].low += later.squares_[i].low;
    }
}

Vec3d Film::mean(Pixel pixel) const noexcept {
    const std::size_t i = index(pixel);
    return counts_[i] == 0 ? Vec3d{} : sums_[i].value() / static_cast<double>(counts_[i]);
}

Vec3d Film::second_moment(Pixel pixel) const noexcept {
    const std::size_t i = index(pixel);
    return counts_[i] == 0 || squares_.empty() ? Vec3d{} : squares_[i].value() / static_cast<double>(counts_[i]);
}

std::vector<float> Film::image() const {
    std::vector<float> out;
    out.reserve(3 * sums_.size());
    for (std::int32_t y = 0; y < rect_.height; ++y)
        for (std::int32_t x = 0; x < rect_.width; ++x) {
            const Vec3f m = to_float(mean({rect_.x + x, rect_.y + y}));
            out.insert(out.end(), {m.x, m.y, m.z});
        }
    return out;
}

Vec3d Film::mean() const noexcept {
    Vec3d sum;
    for (std::int32_t y = 0; y < rect_.height; ++y)
        for (std::int32_t x = 0; x < rect_.width; ++x) sum += mean({rect_.x + x, rect_.y + y});
    return sums_.empty() ? sum : sum / static_cast<double>(sums_.size());
}

}  // namespace koksma
