#include <koksma/scene/animation.h>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <glm/matrix.hpp>

#include <algorithm>
#include <cmath>

namespace koksma {

namespace {

/// m = translation x rotation x stretch. A mirror is in the stretch.
struct Parts {
    glm::dvec3 translation;
    glm::dquat rotation;
    glm::dmat3 stretch;
};

double largest(const glm::dmat3& m) {
    double most = 0.0;
    for (int c = 0; c < 3; ++c)
        for (int r = 0; r < 3; ++r) most = std::max(most, std::fabs(m[c][r]));
    return most;
}

Parts taken_apart(const glm::dmat4& m) {
    const glm::dmat3 linear(m);
    glm::dmat3 q = linear;
    for (int i = 0; i < 100; ++i) {
        // Scaled by the determinant, so that it converges quadratically from the first step on.
        const double scale = std::pow(std::fabs(glm::determinant(q)), -1.0 / 3.0);
        const glm::dmat3 s = q * scale, next = (s + glm::transpose(glm::inverse(s))) * 0.5;
        const double change = largest(next - q);
        q = next;
        if (change < 1e-15) break;
    }
    if (glm::determinant(q) < 0.0) q = -q;
    return {glm::dvec3(m[3]), glm::normalize(glm::quat_cast(q)), glm::transpose(q) * linear};
}

glm::dmat4 put_together(const Parts& p) {
    glm::dmat4 m(glm::mat3_cast(p.rotation) * p.stretch);
    m[3] = glm::dvec4(p.translation, 1.0);
    return m;
}

glm::dmat4 mixed(const glm::dmat4& a, const glm::dmat4& b, double f) { return a * (1.0 - f) + b * f; }

/// Of linear parts in units of the largest entry, of translations in units of that and of the way.
double deviation(const glm::dmat4& a, const glm::dmat4& b, double size, double way) {
    const glm::dvec3 t = glm::abs(glm::dvec3(a[3]) - glm::dvec3(b[3]));
    return std::max(largest(glm::dmat3(a) - glm::dmat3(b)) / size, std::max({t.x, t.y, t.z}) / (size + way));
}

/// @param parts  gives the parts of a keyframe by its index
template <class F>
glm::dmat4 interpolated(const Animation& animation, F&& parts, double time) {
    const auto after = std::upper_bound(animation.begin(), animation.end(), time, [](double t, const Keyframe& k) { return t < k.time; });
    if (after == animation.begin()) return after->to_world;
    if (after == animation.end()) return animation.back().to_world;
    const Keyframe &first = *(after - 1), &second = *after;
    const double f = (time - first.time) / (second.time - first.time);
    if (f == 0.0 || first.to_world == second.to_world) return first.to_world;
    const auto index = static_cast<std::size_t>(after - animation.begin());
    const Parts a = parts(index - 1), b = parts(index);
    return put_together({glm::mix(a.translation, b.translation, f), glm::slerp(a.rotation, b.rotation, f), a.stretch * (1.0 - f) + b.stretch * f});
}

}  // namespace

glm::dmat4 placement_at(const Animation& animation, double time) {
    return interpolated(animation, [&](std::size_t i) { return taken_apart(animation[i].to_world); }, time);
}

std::vector<glm::dmat4> sampled(const Animation& animation, double open, double close) {
    constexpr double kTolerance = 1e-4;
    // Looked at four times a smallest piece, and at every keyframe.
    std::vector<double> instants;
    for (std::size_t i = 0; i <= 4 * kMostMotionSteps; ++i)
        instants.push_back(static_cast<double>(i) / static_cast<double>(4 * kMostMotionSteps));
    for (const Keyframe& k : animation)
        if (k.time > open && k.time < close) instants.push_back((k.time - open) / (close - open));
    std::vector<Parts> parts;
    for (const Keyframe& k : animation) parts.push_back(taken_apart(k.to_world));
    const auto at = [&](double f) { return interpolated(animation, [&](std::size_t i) { return parts[i]; }, open + f * (close - open)); };
    std::vector<glm::dmat4> exact;
    double size = 0.0, way = 0.0;
    bool moves = false;
    for (const double f : instants) {
        exact.push_back(at(f));
        size = std::max(size, largest(glm::dmat3(exact.back())));
        way = std::max(way, glm::distance(glm::dvec3(exact.back()[3]), glm::dvec3(exact.front()[3])));
        moves = moves || exact.back() != exact.front();
    }
    if (!moves) return {exact.front()};
    std::vector<glm::dmat4> steps;
    for (std::size_t n = 1; n <= kMostMotionSteps; n *= 2) {
        steps.clear();
        for (std::size_t i = 0; i <= n; ++i) steps.push_back(at(static_cast<double>(i) / static_cast<double>(n)));
        double worst = 0.0;
        for (std::size_t i = 0; i < instants.size(); ++i) {
            const double scaled = instants[i] * static_cast<double>(n);
            const auto k = std::min(static_cast<std::size_t>(scaled), n - 1);
            worst = std::max(worst, deviation(mixed(steps[k], steps[k + 1], scaled - static_cast<double>(k)), exact[i], size, way));
        }
        if (worst <= kTolerance) break;
    }
    return steps;
}

}  // namespace koksma
