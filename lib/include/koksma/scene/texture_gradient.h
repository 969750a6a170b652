#pragma once
// Textures as heights.

#include <koksma/scene/texture.h>

namespace koksma {

/// Derivatives of a texture's luminance by u and v: of a bilinear bitmap within its cell; others are flat.
[[nodiscard]] Vec2f gradient(const Texture& texture, glm::vec2 uv) noexcept;

}  // namespace koksma
