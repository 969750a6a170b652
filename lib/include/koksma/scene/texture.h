#pragma once
// Values over a surface at render time. A constant costs no lookup.

#include <koksma/scene/description.h>
#include <koksma/math/vec3.h>

#include <span>

namespace koksma {

/// A constant, or the index of a texture in Scene::textures.
struct TextureRef {
    Vec3f constant{0.0f};
    std::int32_t index = -1;
};

/// Bilinear or nearest, wrapped as the texture says; row 0 of the image is at v = 0.
[[nodiscard]] Vec3f lookup(const BitmapTexture& texture, glm::vec2 uv) noexcept;
[[nodiscard]] Vec3f lookup(const CheckerboardTexture& texture, glm::vec2 uv) noexcept;
[[nodiscard]] Vec3f lookup(const Texture& texture, glm::vec2 uv) noexcept;

/// The mean over the unit square (for light powers).
[[nodiscard]] Vec3f mean(const Texture& texture);

}  // namespace koksma
