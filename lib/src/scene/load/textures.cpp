#include "textures.h"

#include "fail.h"
#include "files.h"
#include "transforms.h"

#include <koksma/scene/load.h>

namespace koksma::loader {
namespace {

glm::dmat3 read_to_uv(Properties& p) { return uv_transform(p.transform("to_uv")); }

void check_texels(const Image& image, ColorUse use, const SourceLocation& where, const std::string& file) {
    for (std::size_t i = 0; i < image.texels.size(); ++i) {
        const Rgb& texel = image.texels[i];
        if (use == ColorUse::reflectance && !(texel.r <= 1.0f && texel.g <= 1.0f && texel.b <= 1.0f)) {
            const auto width = static_cast<std::size_t>(image.width);
            check_color(texel, use, where, fmt::format("texel ({}, {}) of {}", i % width, i / width, file));
        }
    }
}

Texture parse_bitmap(Properties& p, ColorUse use, Context& context) {
    BitmapTexture t;
    const std::string name = p.required_text("filename");
    const bool raw = p.boolean("raw", false);
    t.filter = p.choice("filter_type", "bilinear", {"bilinear", "nearest"}) == "nearest" ? BitmapTexture::Filter::nearest
                                                                                         : BitmapTexture::Filter::bilinear;
    const std::string wrap = p.choice("wrap_mode", "repeat", {"repeat", "mirror", "clamp"});
    t.wrap = wrap == "mirror" ? BitmapTexture::Wrap::mirror : wrap == "clamp" ? BitmapTexture::Wrap::clamp : BitmapTexture::Wrap::repeat;
    t.to_uv = read_to_uv(p);
    p.finish();
    t.image = shared_image(name, raw, p.where("filename"), context);
    check_texels(*t.image, use, p.where("filename"), name);
    return t;
}

Texture parse_checkerboard(Properties& p, ColorUse use) {
    CheckerboardTexture t;
    t.color0 = read_constant(p, "color0", t.color0, ColorUse::any);
    t.color1 = read_constant(p, "color1", t.color1, ColorUse::any);
    t.to_uv = read_to_uv(p);
    p.finish();
    check_color(t.color0, use, p.where("color0"), "'color0'");
    check_color(t.color1, use, p.where("color1"), "'color1'");
    return t;
}

Texture parse_mesh_attribute(Properties& p, ColorUse use) {
    MeshAttributeTexture t;
    t.name = p.required_text("name");
    if (!(t.name.starts_with("vertex_") || t.name.starts_with("face_")))
        fail(p.where("name"), "'{}' is not an attribute of meshes; its name begins with vertex_ or face_", t.name);
    t.scale = static_cast<float>(p.number("scale", 1.0));
    if (!(t.scale >= 0.0f)) fail(p.where("scale"), "'scale' is {}; it must not be negative", t.scale);
    t.reflectance = use == ColorUse::reflectance;
    p.finish();
    return t;
}

}  // namespace

std::shared_ptr<const Image> shared_image(const std::string& name, bool raw, const SourceLocation& where, Context& context) {
    const auto file = resolve(name, context.search, where);
    auto& image = context.images[{file.string(), raw}];
    if (image) return image;
    try {
        return image = std::make_shared<const Image>(load_image(file, raw));
    } catch (const Error& e) {
        fail(where, "{}", e.what());
    }
}

Texture parse_texture(const Element& element, ColorUse use, Context& context) {
    Properties p(element, context.ids, {"bitmap", "checkerboard", "mesh_attribute"});
    if (p.type() == "mesh_attribute") {
        if (use == ColorUse::emission) fail(p.where(), "a mesh_attribute is not supported as light");
        return parse_mesh_attribute(p, use);
    }
    return p.type() == "bitmap" ? parse_bitmap(p, use, context) : parse_checkerboard(p, use);
}

Texture read_texture(Properties& from, const std::string& name, const Rgb& default_value, ColorUse use, Context& context) {
    const Element* value = from.value(name);
    if (!value) return default_value;
    if (value->tag == "texture") return parse_texture(*value, use, context);
    return parse_color(*value, use);
}

Rgb read_constant(Properties& from, const std::string& name, const Rgb& default_value, ColorUse use) {
    const Element* value = from.value(name);
    if (!value) return default_value;
    if (value->tag == "texture")
        fail(from.where(name), "'{}' of '{}' must be one colour; a texture is not supported here", name, from.type());
    return parse_color(*value, use);
}

}  // namespace koksma::loader
