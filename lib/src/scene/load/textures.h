#pragma once
// Textures: constants, bitmap, checkerboard.

#include "context.h"
#include "spectra.h"

namespace koksma::loader {

/// A parameter that is a colour or a texture. @throws Error
[[nodiscard]] Texture read_texture(Properties& from, const std::string& name, const Rgb& default_value, ColorUse use, Context& context);

/// A parameter that must be one colour. @throws Error
[[nodiscard]] Rgb read_constant(Properties& from, const std::string& name, const Rgb& default_value, ColorUse use);

/// A <texture> element. @throws Error
[[nodiscard]] Texture parse_texture(const Element& element, ColorUse use, Context& context);

/// Reads an image once per file and `raw`. @throws Error at `where`
[[nodiscard]] std::shared_ptr<const Image> shared_image(const std::string& name, bool raw, const SourceLocation& where, Context& context);

}  // namespace koksma::loader
