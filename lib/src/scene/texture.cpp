#include <koksma/scene/texture.h>
#include <koksma/scene/texture_gradient.h>

#include <cmath>

namespace koksma {

namespace {

/// Applies a texture's uv transform in float (affine).
glm::vec2 transformed(const glm::dmat3& m, glm::vec2 uv) noexcept {
    return {static_cast<float>(m[0][0]) * uv.x + static_cast<float>(m[1][0]) * uv.y + static_cast<float>(m[2][0]),
            static_cast<float>(m[0][1]) * uv.x + static_cast<float>(m[1][1]) * uv.y + static_cast<float>(m[2][1])};
}

int wrapped(int i, int n, BitmapTexture::Wrap wrap) noexcept {
    switch (wrap) {
        case BitmapTexture::Wrap::clamp: return i < 0 ? 0 : (i >= n ? n - 1 : i);
        case BitmapTexture::Wrap::mirror: {
            const int period = 2 * n;
            const int k = ((i % period) + period) % period;
            return k < n ? k : period - 1 - k;
        }
        case BitmapTexture::Wrap::repeat: break;
    }
    return ((i % n) + n) % n;
}

/// floor as an int; far-out coordinates wrap to 0 instead of overflowing.
int floor_to_int(float x) noexcept {
    const float f = std::floor(x);
    return std::fabs(f) < 1e9f ? static_cast<int>(f) : 0;
}

}  // namespace

Vec3f lookup(const BitmapTexture& texture, glm::vec2 uv) noexcept {
    const Image& image = *texture.image;
    uv = transformed(texture.to_uv, uv);
    const auto texel = [&](int x, int y) -> Vec3f {
        x = wrapped(x, image.width, texture.wrap);
        y = wrapped(y, image.height, texture.wrap);
        return image.texels[static_cast<std::size_t>(y) * image.width + x];
    };
    const float fx = uv.x * static_cast<float>(image.width), fy = uv.y * static_cast<float>(image.height);
    if (texture.filter == BitmapTexture::Filter::nearest) return texel(floor_to_int(fx), floor_to_int(fy));
    const float sx = fx - 0.5f, sy = fy - 0.5f;
    const int x = floor_to_int(sx), y = floor_to_int(sy);
    const float wx = sx - std::floor(sx), wy = sy - std::floor(sy);
    return (texel(x, y) * (1.0f - wx) + texel(x + 1, y) * wx) * (1.0f - wy) + (texel(x, y + 1) * (1.0f - wx) + texel(x + 1, y + 1) * wx) * wy;
}

Vec3f lookup(const CheckerboardTexture& texture, glm::vec2 uv) noexcept {
    uv = transformed(texture.to_uv, uv);
    const bool a = uv.x - std::floor(uv.x) > 0.5f, b = uv.y - std::floor(uv.y) > 0.5f;
    return a == b ? texture.color0 : texture.color1;
}

Vec3f lookup(const Texture& texture, glm::vec2 uv) noexcept {
    if (const auto* bitmap = std::get_if<BitmapTexture>(&texture)) return lookup(*bitmap, uv);
    if (const auto* checkerboard = std::get_if<CheckerboardTexture>(&texture)) return lookup(*checkerboard, uv);
    if (std::holds_alternative<MeshAttributeTexture>(texture)) return Vec3f{0.0f};  // who has the mesh looks it up there
    return std::get<Rgb>(texture);
}

Vec2f gradient(const Texture& texture, glm::vec2 uv) noexcept {
    const auto* bitmap = std::get_if<BitmapTexture>(&texture);
    if (bitmap == nullptr || bitmap->filter == BitmapTexture::Filter::nearest) return {};
    const Image& image = *bitmap->image;
    const glm::dmat3& m = bitmap->to_uv;
    uv = transformed(m, uv);
    const auto texel = [&](int x, int y) -> float {
        x = wrapped(x, image.width, bitmap->wrap);
        y = wrapped(y, image.height, bitmap->wrap);
        return luminance(Vec3f(image.texels[static_cast<std::size_t>(y) * image.width + x]));
    };
    const auto width = static_cast<float>(image.width), height = static_cast<float>(image.height);
    const float sx = uv.x * width - 0.5f, sy = uv.y * height - 0.5f;
    const int x = floor_to_int(sx), y = floor_to_int(sy);
    const float wx = sx - std::floor(sx), wy = sy - std::floor(sy);
    const float t00 = texel(x, y), t10 = texel(x + 1, y), t01 = texel(x, y + 1), t11 = texel(x + 1, y + 1);
    const float du = ((t10 - t00) * (1.0f - wy) + (t11 - t01) * wy) * width, dv = ((t01 - t00) * (1.0f - wx) + (t11 - t10) * wx) * height;
    return {du * static_cast<float>(m[0][0]) + dv * static_cast<float>(m[0][1]), du * static_cast<float>(m[1][0]) + dv * static_cast<float>(m[1][1])};
}

Vec3f mean(const Texture& texture) {
    if (const auto* bitmap = std::get_if<BitmapTexture>(&texture)) {
        Vec3d sum;
        for (const Rgb& t : bitmap->image->texels) sum += to_double(t);
        return to_float(sum / static_cast<double>(bitmap->image->texels.size()));
    }
    if (const auto* checkerboard = std::get_if<CheckerboardTexture>(&texture)) return (Vec3f(checkerboard->color0) + Vec3f(checkerboard->color1)) * 0.5f;
    if (std::holds_alternative<MeshAttributeTexture>(texture)) return Vec3f{0.0f};  // unknown here; lights do not take it
    return std::get<Rgb>(texture);
}

}  // namespace koksma
