#include <koksma/measure/flip.h>
#include <koksma/sampling/error.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <string>

namespace koksma {
namespace {

using Plane = std::vector<float>;
constexpr double kPi = 3.14159265358979323846;

/// Linear Rec. 709 RGB to XYZ, as the paper's supplement gives it, and its illuminant (its rows' sums).
constexpr double kXyz[3][3] = {{10135552.0 / 24577794, 8788810.0 / 24577794, 4435075.0 / 24577794},
                               {2613072.0 / 12288897, 8788810.0 / 12288897, 887015.0 / 12288897},
                               {1425312.0 / 73733382, 8788810.0 / 73733382, 70074185.0 / 73733382}};
constexpr double white(int row) { return kXyz[row][0] + kXyz[row][1] + kXyz[row][2]; }

/// Rows: (XYZ / white) of unit R, G, B. FLIP needs nothing but these ratios.
struct Ratios {
    float to[3][3], from[3][3];
    Ratios() {
        double m[3][3], inverse[3][3];
        for (int r = 0; r < 3; ++r)
            for (int c = 0; c < 3; ++c) m[r][c] = kXyz[r][c] / white(r);
        double determinant = 0;
        for (int c = 0; c < 3; ++c) determinant += m[0][c] * (m[1][(c + 1) % 3] * m[2][(c + 2) % 3] - m[1][(c + 2) % 3] * m[2][(c + 1) % 3]);
        for (int r = 0; r < 3; ++r)
            for (int c = 0; c < 3; ++c)
                inverse[c][r] = (m[(r + 1) % 3][(c + 1) % 3] * m[(r + 2) % 3][(c + 2) % 3] - m[(r + 1) % 3][(c + 2) % 3] * m[(r + 2) % 3][(c + 1) % 3]) / determinant;
        for (int r = 0; r < 3; ++r)
            for (int c = 0; c < 3; ++c) {
                to[r][c] = static_cast<float>(m[r][c]);
                from[r][c] = static_cast<float>(inverse[r][c]);
            }
    }
};
const Ratios& ratios() {
    static const Ratios kRatios;
    return kRatios;
}

/// A symmetric or antisymmetric filter along one axis: weights of offsets -radius to radius.
using Taps = std::vector<float>;

/// Filters rows (or, transposed, columns); the border pixel is repeated outwards.
void along_rows(const Plane& in, Plane& out, int width, int height, const Taps& taps) {
    const int radius = static_cast<int>(taps.size() / 2);
    std::vector<float> padded(static_cast<std::size_t>(width + 2 * radius));
    out.resize(in.size());
    for (int y = 0; y < height; ++y) {
        const float* row = &in[static_cast<std::size_t>(y) * static_cast<std::size_t>(width)];
        for (int x = -radius; x < width + radius; ++x) padded[static_cast<std::size_t>(x + radius)] = row[std::clamp(x, 0, width - 1)];
        float* to = &out[static_cast<std::size_t>(y) * static_cast<std::size_t>(width)];
        std::fill(to, to + width, 0.0f);
        for (std::size_t k = 0; k < taps.size(); ++k) {
            const float w = taps[k];
            const float* from = &padded[k];
            for (int x = 0; x < width; ++x) to[x] += w * from[x];
        }
    }
}
void along_columns(const Plane& in, Plane& out, int width, int height, const Taps& taps) {
    const int radius = static_cast<int>(taps.size() / 2);
    out.assign(in.size(), 0.0f);
    for (int y = 0; y < height; ++y) {
        float* to = &out[static_cast<std::size_t>(y) * static_cast<std::size_t>(width)];
        for (std::size_t k = 0; k < taps.size(); ++k) {
            const float w = taps[k];
            const int from_y = std::clamp(y + static_cast<int>(k) - radius, 0, height - 1);
            const float* from = &in[static_cast<std::size_t>(from_y) * static_cast<std::size_t>(width)];
            for (int x = 0; x < width; ++x) to[x] += w * from[x];
        }
    }
}
void separable(const Plane& in, Plane& out, Plane& scratch, int width, int height, const Taps& x, const Taps& y) {
    along_rows(in, scratch, width, height, x);
    along_columns(scratch, out, width, height, y);
}

/// A channel's contrast sensitivity as a sum of two Gaussians in space, table 1 of the 2020 paper: a sqrt(pi / b) exp(-pi^2 x^2 / b), x in
/// degrees.
struct Sensitivity {
    double a[2], b[2];
};
constexpr Sensitivity kSensitivity[3] = {{{1, 0}, {0.0047, 1e-5}}, {{1, 0}, {0.0053, 1e-5}}, {{34.1, 13.5}, {0.04, 0.025}}};

/// Per Gaussian taps of one axis, whose products over two axes add up to 1 over the channel.
std::array<Taps, 2> sensitivity_taps(const Sensitivity& s, double ppd) {
    constexpr double kWidest = 0.04;  // all channels' filters have the radius of the widest
    const int radius = static_cast<int>(std::ceil(3 * std::sqrt(kWidest / (2 * kPi * kPi)) * ppd));
    std::array<std::vector<double>, 2> gauss;
    double total = 0;
    for (std::size_t g = 0; g < 2; ++g) {
        double sum = 0;
        for (int x = -radius; x <= radius; ++x) {
            const double degrees = x / ppd;
            gauss[g].push_back(std::exp(-kPi * kPi * degrees * degrees / s.b[g]));
            sum += gauss[g].back();
        }
        total += s.a[g] * std::sqrt(kPi / s.b[g]) * sum * sum;
    }
    std::array<Taps, 2> taps;
    for (std::size_t g = 0; g < 2; ++g) {
        if (s.a[g] == 0) continue;
        const double scale = std::sqrt(s.a[g] * std::sqrt(kPi / s.b[g]) / total);
        for (const double w : gauss[g]) taps[g].push_back(static_cast<float>(scale * w));
    }
    return taps;
}

/// Gaussian and its first two derivatives; the positive weights of each add up to 1, the negative ones to -1.
struct FeatureTaps {
    Taps gauss, first, second;
    explicit FeatureTaps(double ppd) {
        constexpr double kFeatureWidth = 0.082;  // degrees, peak to trough of an edge detector; section 4.2
        const double sigma = 0.5 * kFeatureWidth * ppd;
        const int radius = static_cast<int>(std::ceil(3 * sigma));
        std::vector<double> g, d, dd;
        for (int x = -radius; x <= radius; ++x) {
            g.push_back(std::exp(-x * x / (2 * sigma * sigma)));
            d.push_back(-x * g.back());
            dd.push_back((x * x / (sigma * sigma) - 1) * g.back());
        }
        gauss = normalised(g);
        first = normalised(d);
        second = normalised(dd);
    }
    static Taps normalised(const std::vector<double>& weights) {
        double positive = 0, negative = 0;
        for (const double w : weights) (w > 0 ? positive : negative) += std::abs(w);
        Taps taps;
        for (const double w : weights) taps.push_back(static_cast<float>(w > 0 ? w / positive : (negative > 0 ? w / negative : w)));
        return taps;
    }
};

/// CIE 1976 L*a*b* of clamped linear RGB, a* and b* scaled by 0.01 L* (Hunt), section 4.1.3.
std::array<float, 3> hunt_lab(const float rgb[3]) {
    float f[3];
    for (int r = 0; r < 3; ++r) {
        const float t = ratios().to[r][0] * rgb[0] + ratios().to[r][1] * rgb[1] + ratios().to[r][2] * rgb[2];
        constexpr float kDelta = 6.0f / 29.0f;
        f[r] = t > kDelta * kDelta * kDelta ? std::cbrt(t) : t / (3 * kDelta * kDelta) + 4.0f / 29.0f;
    }
    const float lightness = 116 * f[1] - 16;
    return {lightness, 0.01f * lightness * 500 * (f[0] - f[1]), 0.01f * lightness * 200 * (f[1] - f[2])};
}

float hyab(const std::array<float, 3>& p, const std::array<float, 3>& q) { return std::abs(p[0] - q[0]) + std::hypot(p[1] - q[1], p[2] - q[2]); }

constexpr float kColourExponent = 0.7f;  // q_c, section 4.1.4

/// The largest colour difference: green against blue.
float largest_difference() {
    const float green[] = {0, 1, 0}, blue[] = {0, 0, 1};
    static const float kLargest = std::pow(hyab(hunt_lab(green), hunt_lab(blue)), kColourExponent);
    return kLargest;
}

/// Compresses large differences: up to p_c of the largest onto [0, p_t], the rest onto [p_t, 1].
float redistributed(float difference) {
    constexpr float kPc = 0.4f, kPt = 0.95f;
    const float largest = largest_difference(), knee = kPc * largest;
    return difference < knee ? kPt / knee * difference : kPt + (difference - knee) / (largest - knee) * (1 - kPt);
}

void check_size(std::span<const float> image, int width, int height, const char* what) {
    const bool positive = width > 0 && height > 0;
    if (!positive || image.size() != std::size_t{3} * static_cast<std::size_t>(width) * static_cast<std::size_t>(height))
        throw Error(std::string("FLIP: found ") + std::to_string(image.size()) + " values in the " + what + ", expected " + std::to_string(height) + " x " +
                    std::to_string(width) + " x 3");
}

/// Folds the map of one pair into a running maximum.
void keep_largest(const FlipFeatures& r, const FlipFeatures& t, Plane& map) {
    for (std::size_t i = 0; i < map.size(); ++i) {
        const float colour = redistributed(std::pow(hyab({r.lightness[i], r.a[i], r.b[i]}, {t.lightness[i], t.a[i], t.b[i]}), kColourExponent));
        const float feature = std::max(std::abs(r.edge[i] - t.edge[i]), std::abs(r.point[i] - t.point[i]));
        const float amplified = std::sqrt(std::min(1.0f, feature / std::sqrt(2.0f)));  // q_f = 0.5, section 4.3
        map[i] = std::max(map[i], std::pow(colour, 1 - amplified));
    }
}

/// ACES as fitted by Narkowicz 2015 with its exposure of 0.6: (a x^2 + b x) / (c x^2 + d x + e).
constexpr double kAces[5] = {0.6 * 0.6 * 2.51, 0.6 * 0.03, 0.6 * 0.6 * 2.43, 0.6 * 0.59, 0.14};

/// The x that is tone mapped to y.
double inverse_aces(double y) {
    const double a = kAces[0] - kAces[2] * y, b = kAces[1] - kAces[3] * y, c = -kAces[4] * y;
    return (-b + std::sqrt(b * b - 4 * a * c)) / (2 * a);
}

Plane tone_mapped(std::span<const float> rgb, double exposure) {
    Plane out(rgb.size());
    const auto scale = static_cast<float>(std::exp2(exposure));
    for (std::size_t i = 0; i < rgb.size(); ++i) {
        const float x = scale * rgb[i];
        const float y = (static_cast<float>(kAces[0]) * x * x + static_cast<float>(kAces[1]) * x) /
                        (static_cast<float>(kAces[2]) * x * x + static_cast<float>(kAces[3]) * x + static_cast<float>(kAces[4]));
        out[i] = std::clamp(y, 0.0f, 1.0f);
    }
    return out;
}

bool all_finite(std::span<const float> values) {
    return std::all_of(values.begin(), values.end(), [](float v) { return std::isfinite(v); });
}

}  // namespace

FlipFeatures flip_features(std::span<const float> rgb, int width, int height, double ppd) {
    check_size(rgb, width, height, "image");
    const std::size_t n = rgb.size() / 3;
    Plane opponent[3];  // Y, Cx, Cz; the offset of Y drops out of everything
    for (Plane& p : opponent) p.resize(n);
    for (std::size_t i = 0; i < n; ++i) {
        float t[3];
        for (int r = 0; r < 3; ++r) t[r] = ratios().to[r][0] * rgb[3 * i] + ratios().to[r][1] * rgb[3 * i + 1] + ratios().to[r][2] * rgb[3 * i + 2];
        opponent[0][i] = t[1];
        opponent[1][i] = t[0] - t[1];
        opponent[2][i] = t[1] - t[2];
    }
    FlipFeatures f;
    Plane scratch, part, x, y;
    const FeatureTaps feature(ppd);
    const auto magnitude = [&](const Taps& derivative) {
        separable(opponent[0], x, scratch, width, height, derivative, feature.gauss);
        separable(opponent[0], y, scratch, width, height, feature.gauss, derivative);
        Plane out(n);
        for (std::size_t i = 0; i < n; ++i) out[i] = std::sqrt(x[i] * x[i] + y[i] * y[i]);
        return out;
    };
    f.edge = magnitude(feature.first);
    f.point = magnitude(feature.second);
    for (std::size_t c = 0; c < 3; ++c) {
        Plane sum(n, 0.0f);
        for (const Taps& taps : sensitivity_taps(kSensitivity[c], ppd)) {
            if (taps.empty()) continue;
            separable(opponent[c], part, scratch, width, height, taps, taps);
            for (std::size_t i = 0; i < n; ++i) sum[i] += part[i];
        }
        opponent[c] = std::move(sum);
    }
    f.lightness.resize(n);
    f.a.resize(n);
    f.b.resize(n);
    for (std::size_t i = 0; i < n; ++i) {
        const float t[3] = {opponent[1][i] + opponent[0][i], opponent[0][i], opponent[0][i] - opponent[2][i]};
        float clamped[3];
        for (int r = 0; r < 3; ++r) clamped[r] = std::clamp(ratios().from[r][0] * t[0] + ratios().from[r][1] * t[1] + ratios().from[r][2] * t[2], 0.0f, 1.0f);
        const std::array<float, 3> lab = hunt_lab(clamped);
        f.lightness[i] = lab[0];
        f.a[i] = lab[1];
        f.b[i] = lab[2];
    }
    return f;
}

std::vector<float> ldr_flip(std::span<const float> reference, std::span<const float> test, int width, int height, double ppd) {
    check_size(reference, width, height, "reference");
    Plane map(reference.size() / 3, 0.0f);
    keep_largest(flip_features(reference, width, height, ppd), flip_features(test, width, height, ppd), map);
    return map;
}

HdrFlip::HdrFlip(std::span<const float> reference, int width, int height, double ppd) : width_(width), height_(height), pixels_per_degree_(ppd) {
    check_size(reference, width, height, "reference");
    if (!all_finite(reference)) return;
    std::vector<double> luminance;
    for (std::size_t i = 0; i < reference.size(); i += 3)
        luminance.push_back(kXyz[1][0] * reference[i] + kXyz[1][1] * reference[i + 1] + kXyz[1][2] * reference[i + 2]);
    const auto middle = luminance.begin() + static_cast<std::ptrdiff_t>(luminance.size() / 2);
    std::nth_element(luminance.begin(), middle, luminance.end());
    // A median of 0 would never be bright; the evaluator takes the rounding of a float instead.
    const double median = std::max(*middle, 0x1p-23), largest = *std::max_element(luminance.begin(), luminance.end());
    if (!(largest > median)) return;
    const double target = inverse_aces(0.85);
    start_ = std::log2(target / largest);
    stop_ = std::log2(target / median);
    const int count = std::max(2, static_cast<int>(std::ceil(stop_ - start_)));
    features_.resize(static_cast<std::size_t>(count));
    for (int i = 0; i < count; ++i) features_[static_cast<std::size_t>(i)] = flip_features(tone_mapped(reference, exposure(i)), width, height, ppd);
}

double HdrFlip::exposure(int i) const noexcept { return start_ + (stop_ - start_) * i / (exposures() - 1); }

std::vector<float> HdrFlip::map(std::span<const float> test) const {
    check_size(test, width_, height_, "image");
    if (features_.empty() || !all_finite(test)) return {};
    Plane map(test.size() / 3, 0.0f);
    for (int i = 0; i < exposures(); ++i)
        keep_largest(features_[static_cast<std::size_t>(i)], flip_features(tone_mapped(test, exposure(i)), width_, height_, pixels_per_degree_), map);
    return map;
}

double HdrFlip::mean(std::span<const float> test, std::span<const unsigned char> skip) const { return mean_of_map(map(test), skip); }

double mean_of_map(std::span<const float> map, std::span<const unsigned char> skip) {
    double sum = 0, n = 0;
    for (std::size_t i = 0; i < map.size(); ++i) {
        if (!skip.empty() && skip[i] != 0) continue;
        sum += static_cast<double>(map[i]);
        ++n;
    }
    return n > 0 ? sum / n : std::numeric_limits<double>::quiet_NaN();
}

}  // namespace koksma
