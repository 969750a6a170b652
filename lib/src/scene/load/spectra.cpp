#include "spectra.h"

#include "fail.h"
#include "files.h"
#include "numbers.h"
#include "spectrum_table.h"

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

double spectrum_number(std::string_view text, const Element& element) {
    const auto v = parse_double(text);
    if (!v || !finite_float(*v)) fail(element.where, "'{}' in a spectrum is not a finite number", text);
    return *v;
}

/// "nm:value, nm:value".
std::vector<SpectrumPoint> inline_table(std::string_view text, const Element& element) {
    std::vector<SpectrumPoint> table;
    constexpr std::string_view kSeparators = ", \t\r\n";
    for (auto begin = text.find_first_not_of(kSeparators); begin != std::string_view::npos; begin = text.find_first_not_of(kSeparators)) {
        text.remove_prefix(begin);
        const std::string_view pair = text.substr(0, text.find_first_of(kSeparators));
        text.remove_prefix(pair.size());
        const auto colon = pair.find(':');
        if (colon == std::string_view::npos) fail(element.where, "'{}' in a spectrum is not \"wavelength:value\"", pair);
        table.push_back({spectrum_number(pair.substr(0, colon), element), spectrum_number(pair.substr(colon + 1), element)});
    }
    return table;
}

/// Lines "nm value"; # begins a comment.
std::vector<SpectrumPoint> file_table(const Element& element) {
    const std::string bytes = read_file(resolve(element.required("filename"), {}, element.where));
    std::vector<SpectrumPoint> table;
    std::string_view text = bytes;
    while (!text.empty()) {
        std::string_view line = text.substr(0, text.find('\n'));
        text.remove_prefix(std::min(text.size(), line.size() + 1));
        line = trimmed(line.substr(0, line.find('#')));
        if (line.empty()) continue;
        const auto numbers = parse_doubles(line);
        if (!numbers || numbers->size() != 2 || !finite_float((*numbers)[0]) || !finite_float((*numbers)[1]))
            fail(element.where, "'{}' in {} is not a wavelength and a value", line, element.required("filename"));
        table.push_back({(*numbers)[0], (*numbers)[1]});
    }
    return table;
}

/// As Mitsuba's rgb variants reduce it: colours out of the gamut are clamped, reflectances also to one.
Rgb reduced(const std::vector<SpectrumPoint>& table, ColorUse use, const Element& element) {
    if (table.size() < 2) fail(element.where, "a spectrum by wavelength needs at least two points; found {}", table.size());
    for (std::size_t i = 1; i < table.size(); ++i)
        if (!(table[i].nm > table[i - 1].nm))
            fail(element.where, "the wavelengths of a spectrum must increase; found {} after {}", table[i].nm, table[i - 1].nm);
    for (const SpectrumPoint& p : table)
        if (use == ColorUse::reflectance && !(p.value >= 0.0 && p.value <= 1.0))
            fail(element.where, "the spectrum is {} at {} nm; a reflectance must be in [0, 1]", p.value, p.nm);
        else if (p.value < 0.0)
            fail(element.where, "the spectrum is {} at {} nm; it must not be negative", p.value, p.nm);
    const glm::dvec3 c = table_color(table, use != ColorUse::emission);
    Rgb color;
    for (int i = 0; i < 3; ++i) {
        color[i] = static_cast<float>(std::max(c[i], 0.0));
        if (use == ColorUse::reflectance) color[i] = std::min(color[i], 1.0f);
    }
    return color;
}

Rgb parse_spectrum(const Element& element, ColorUse use) {
    const std::string* text = element.find("value");
    if (element.find("filename")) {
        if (text) fail(element.where, "give a spectrum 'value' or 'filename', not both");
        return reduced(file_table(element), use, element);
    }
    text = &element.required("value");
    if (text->find(':') != std::string::npos) return reduced(inline_table(*text, element), use, element);
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
