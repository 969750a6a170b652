#include "spectra.h"

#include "fail.h"
#include "numbers.h"

#include <algorithm>

namespace koksma::loader {
namespace {

// A flat spectrum of value 1 as light, in linear sRGB: the equal-energy white X = Y = Z = 1 has this colour, and Mitsuba 3.9.1 in its
// rgb variants gives it to <spectrum value="1"/> of an emitter. (<float> and <rgb> mean R = G = B.) Measured there by mi.traverse.
const Rgb kEqualEnergyWhite{1.20479393f, 0.948291004f, 0.908916056f};

Rgb narrowed(const Element& element, const std::vector<double>& v) {
    Rgb color;
    for (int i = 0; i < 3; ++i) {
        const auto f = finite_float(v[v.size() == 1 ? 0 : static_cast<std::size_t>(i)]);
        if (!f) fail(element.where, "'{}' of <{}>: colours must be finite and fit a float", element.required("value"), element.tag);
        color[i] = *f;
    }
    return color;
}

Rgb parse_rgb(const Element& element) {
    const std::string& text = element.required("value");
    if (text.find('#') != std::string::npos)
        fail(element.where, "'{}': hexadecimal colours are not supported (nor in Mitsuba 3); give three linear numbers", text);
    const auto v = parse_doubles(text);
    if (!v || (v->size() != 1 && v->size() != 3)) fail(element.where, "'{}' is not a colour; expected one number or \"r, g, b\"", text);
    return narrowed(element, *v);
}

Rgb parse_spectrum(const Element& element, ColorUse use) {
    const std::string* text = element.find("value");
    if (!text || text->find(':') != std::string::npos)
        fail(element.where,
             "spectra by wavelength are not supported; supported: <spectrum value=\"one number\"/>, <rgb value=\"r, g, b\"/>");
    const auto v = parse_double(*text);
    if (!v) fail(element.where, "'{}' is not a number", *text);
    const Rgb value = narrowed(element, {*v});
    return use == ColorUse::emission ? value * kEqualEnergyWhite : value;
}

}  // namespace

void check_color(const Rgb& value, ColorUse use, const SourceLocation& where, std::string_view what) {
    if (use == ColorUse::any) return;
    const float highest = std::max({value.r, value.g, value.b});
    if (!(value.r >= 0.0f && value.g >= 0.0f && value.b >= 0.0f))
        fail(where, "{} is {} {} {}; it must not be negative or NaN", what, value.r, value.g, value.b);
    if (use == ColorUse::reflectance && !(highest <= 1.0f))
        fail(where, "{} is {} {} {}; a reflectance must be in [0, 1]", what, value.r, value.g, value.b);
}

Rgb parse_color(const Element& element, ColorUse use) {
    element.allow_no_children();
    if (element.tag == "spectrum")
        element.allow_attributes({"name", "value", "filename"});
    else
        element.allow_attributes({"name", "value"});
    Rgb color;
    if (element.tag == "rgb") {
        color = parse_rgb(element);
    } else if (element.tag == "spectrum") {
        color = parse_spectrum(element, use);
    } else if (element.tag == "float" || element.tag == "integer") {
        const auto v = parse_double(element.required("value"));
        if (!v) fail(element.where, "'{}' is not a number", element.required("value"));
        color = narrowed(element, {*v});
    } else {
        fail(element.where, "expected a colour here (rgb, spectrum, float), found <{}>", element.tag);
    }
    const std::string* name = element.find("name");
    check_color(color, use, element.where, name ? "'" + *name + "'" : "the colour");
    return color;
}

}  // namespace koksma::loader
