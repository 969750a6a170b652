#pragma once
// Spectra given as values at wavelengths, reduced to linear sRGB as Mitsuba's rgb variants do it.

#include <glm/vec3.hpp>

#include <vector>

namespace koksma::loader {

struct SpectrumPoint {
    double nm, value;
};

/// The colour of a spectrum that is linear between its points and zero outside; may be out of the gamut (negative).
/// @param table      at least two points, wavelengths increasing
/// @param under_d65  reflectances and indices are seen under D65; lights are spectra themselves
[[nodiscard]] glm::dvec3 table_color(const std::vector<SpectrumPoint>& table, bool under_d65);

}  // namespace koksma::loader
