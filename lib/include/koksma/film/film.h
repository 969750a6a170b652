#pragma once
// Where samples are summed: in double, in fixed chunks, so that a split of the work at chunk boundaries gives the same bytes.

#include <koksma/math/vec3.h>
#include <koksma/sampling/bits.h>

#include <cstdint>
#include <span>
#include <vector>

namespace koksma {

/// A rectangle of pixels of the full film.
struct PixelRect {
    std::int32_t x = 0, y = 0, width = 0, height = 0;
    [[nodiscard]] constexpr std::int64_t area() const noexcept { return std::int64_t{width} * height; }
};

/// A sample whose radiance was not a number, infinite, or negative. It counts as a sample and adds nothing; it is reported,
/// and `koksma replay` prints its path.
struct InvalidSample {
    enum class Kind : std::uint8_t { nan, infinite, negative } kind = Kind::nan;
    SampleId id;
};
[[nodiscard]] const char* name(InvalidSample::Kind kind) noexcept;

/// Linear sRGB to CIE XYZ (D65), in Mitsuba's digits.
[[nodiscard]] Vec3d xyz_of(Vec3d rgb) noexcept;

/// Classifies radiance. @return true and the kind if it is invalid
[[nodiscard]] bool is_invalid(Vec3f radiance, InvalidSample::Kind& kind) noexcept;

/// Sums of radiance per pixel over a rectangle of the film. Different pixels may be added to by different threads.
class Film {
public:
    /// Samples of a pixel are summed per chunk of this many consecutive indices; chunk sums are added in order of index.
    static constexpr std::uint64_t kChunk = 64;

    Film() = default;
    /// @param moments  also sum the squares of the samples' X, Y, Z
    explicit Film(PixelRect rect, bool moments = false)
        : rect_(rect), sums_(static_cast<std::size_t>(rect.area())), squares_(moments ? sums_.size() : 0), counts_(sums_.size()) {}

    [[nodiscard]] PixelRect rect() const noexcept { return rect_; }

    /// Adds the samples of one chunk (or part of one), in order.
    void add(Pixel pixel, std::span<const Vec3f> radiance) noexcept;
    /// Adds a film of the same rectangle that holds later chunks. Sums of chunks carry 106 bits, so how the chunks were
    /// split between the films does not show in the means' 24. @throws Error if the rectangles differ
    void merge(const Film& later);

    /// Mean radiance of a pixel, (0, 0, 0) before the first sample.
    [[nodiscard]] Vec3d mean(Pixel pixel) const noexcept;
    [[nodiscard]] std::uint64_t count(Pixel pixel) const noexcept { return counts_[index(pixel)]; }
    [[nodiscard]] bool has_moments() const noexcept { return !squares_.empty(); }
    /// Means of X^2, Y^2, Z^2 over the samples of a pixel; zero without moments.
    [[nodiscard]] Vec3d second_moment(Pixel pixel) const noexcept;
    /// All means as floats, shape (height, width, 3).
    [[nodiscard]] std::vector<float> image() const;
    /// Mean over all pixels.
    [[nodiscard]] Vec3d mean() const noexcept;

private:
    [[nodiscard]] std::size_t index(Pixel p) const noexcept {
        return static_cast<std::size_t>(p.y - rect_.y) * static_cast<std::size_t>(rect_.width) + static_cast<std::size_t>(p.x - rect_.x);
    }
    PixelRect rect_;
    /// A sum and what rounding has taken from it.
    struct Sum {
        Vec3d high, low;
        void add(Vec3d v) noexcept;
        [[nodiscard]] Vec3d value() const noexcept { return high + low; }
    };
    std::vector<Sum> sums_, squares_;
    std::vector<std::uint64_t> counts_;
};

}  // namespace koksma
