// Triangles that are needles: what Embree says of them, and their normals.

#include <scenes/render_scene.h>

#include <koksma/scene/surface.h>

using namespace koksma;
using namespace koksma::testing;

namespace {

struct Numbers {
    std::uint32_t key, count = 0;
    double operator()() { return 2.0 * unit_float(keyed_hash({key, 6}, count++)) - 1.0; }
    glm::dvec3 vector() { return {(*this)(), (*this)(), (*this)()}; }
};

Vec3d exact(glm::vec3 v) { return {v.x, v.y, v.z}; }

/// Distance of the ray's line from the nearest point of the triangle, in double.
double distance_to_triangle(Vec3d o, Vec3d d, Vec3d a, Vec3d b, Vec3d c) {
    const Vec3d unit = d * (1.0 / length(d));
    const auto flat = [&](Vec3d p) { return (p - o) - unit * dot(p - o, unit); };  // seen along the ray
    const Vec3d corners[] = {flat(a), flat(b), flat(c)};
    // Inside: all cross products turn the same way.
    int positive = 0, negative = 0;
    double nearest = 1e300;
    for (int i = 0; i < 3; ++i) {
        const Vec3d p = corners[i], e = corners[(i + 1) % 3] - p;
        const double turn = dot(cross(p, corners[(i + 1) % 3]), unit);
        positive += turn > 0;
        negative += turn < 0;
        const double e2 = dot(e, e), t = e2 > 0 ? std::clamp(-dot(p, e) / e2, 0.0, 1.0) : 0.0;
        nearest = std::min(nearest, length(p + e * t));
    }
    return positive == 3 || negative == 3 ? 0.0 : nearest;
}

struct SliverRays {
    int rays = 0, hits = 0, false_hits = 0;
    double worst = 0;    ///< distance by which a ray passed a sliver that it was said to hit
    double off = 0;      ///< of the point that was made of a hit from its triangle
};

/// As in Embree's issue 387: edges of 11.2, 9.7 and 1.4 and thinner, within 600 of the origin, rays about 0.5 degrees from the plane.
SliverRays shoot_slivers() {
    Numbers random{387};
    SliverRays out;
    for (int k = 0; k < 10000; ++k) {
        const glm::dvec3 u = glm::normalize(random.vector()), n = glm::normalize(glm::cross(u, random.vector())), v = glm::cross(n, u);
        const glm::dvec3 centre = 340.0 * random.vector();
        const double thin = std::pow(10.0, -3.0 + 3.0 * std::fabs(random()));
        const glm::vec3 corners[] = {centre, centre + 11.2 * u, centre + 9.7 * u + thin * v};
        SceneDescription d = empty_scene();
        add_shape(d, mesh({corners[0], corners[1], corners[2]}, {{0, 1, 2}}), Matrix(1.0), 0);
        const Scene scene = compile(d);
        for (int i = 0; i < 64; ++i, ++out.rays) {
            // Towards its plane in and around the sliver.
            const double turn = std::acos(-1.0) * random(), tilt = glm::radians(0.55 * random());
            const glm::dvec3 in_plane = std::cos(turn) * u + std::sin(turn) * v, direction = std::cos(tilt) * in_plane + std::sin(tilt) * n;
            const double along = 0.5 + 0.7 * random();
            const glm::dvec3 target = centre + 11.2 * along * u + thin * (along * 0.6 + 0.8 * random()) * v;
            const glm::dvec3 from = target - 300.0 * (1.0 + random()) * direction;
            const Ray ray{Vec3f(glm::vec3(from)), normalize(Vec3f(glm::vec3(direction)))};
            const Hit hit = scene.accelerator.intersect(ray);
            if (!hit.valid()) continue;
            ++out.hits;
            const Vec3d a = exact(corners[0]), b = exact(corners[1]), c = exact(corners[2]);
            const double passed = distance_to_triangle(to_double(ray.o), to_double(ray.d), a, b, c);
            out.worst = std::max(out.worst, passed);
            // Coordinates of up to 900 are exact to 900 x 2^-24 = 5.4e-5; a ray's direction over 600 as much again.
            out.false_hits += passed > 3e-4;
            const Vec3d normal = cross(b - a, c - a);
            out.off = std::max(out.off, distance_to_triangle(to_double(surface_at<EffectSet::all()>(scene, ray, hit).p), normal, a, b, c));
        }
    }
    return out;
}

}  // namespace

// Embree's triangle test in floats says so, within the triangle's bounding box; to check every hit, and every shadow, in double would cost each
// ray of each scene. Open upstream.
TEST_CASE("B6: no sliver is met by a ray that passes it, even half a degree from its plane", "[hard][!mayfail]") {
    const SliverRays r = shoot_slivers();
    INFO(r.false_hits << " of " << r.hits << " hits are false; such a ray passed by " << r.worst << " at most");
    CHECK(r.hits > 10000);
    CHECK(r.false_hits == 0);
}

TEST_CASE("B6: the point of a false hit is on the sliver", "[hard]") {
    const SliverRays r = shoot_slivers();
    INFO(r.false_hits << " of " << r.hits << " hits are false; points are " << r.off << " from their triangles");
    CHECK(r.hits > 10000);
    // Up to 16 roundings of coordinates of 900 beyond its border a point is left where the ray meets the plane.
    CHECK(r.off < 1e-3);
}

TEST_CASE("F9: normals of needles keep their digits", "[hard]") {
    Numbers random{9};
    SceneDescription d = empty_scene();
    std::vector<glm::vec3> corners;
    std::vector<std::array<std::uint32_t, 3>> triangles;
    for (std::uint32_t k = 0; k < 30000; ++k) {
        // Cross products of the edges are differences of products that nearly cancel, down to all but the last digits.
        const glm::vec3 a = random.vector(), e = random.vector(),
                        f = 0.7f * e + std::pow(10.0f, static_cast<float>(-3.0 + 3.0 * random())) * glm::vec3(random.vector());
        corners.insert(corners.end(), {a, a + e, a + f});
        triangles.push_back({3 * k, 3 * k + 1, 3 * k + 2});
    }
    add_shape(d, mesh(corners, triangles), Matrix(1.0), 0);
    const Scene scene = compile(d);
    double worst = 0, rays_worst = 0;
    for (std::uint32_t k = 0; k < triangles.size(); ++k) {
        const Vec3d a = to_double(scene.positions[3 * k]), b = to_double(scene.positions[3 * k + 1]),
                    c = to_double(scene.positions[3 * k + 2]);
        const Vec3d n = cross(b - a, c - a);
        if (!(dot(n, n) > 0.0)) continue;
        const Vec3d unit = n * (1.0 / length(n));
        worst = std::max(worst, length(to_double(triangle_surface<EffectSet::all()>(scene, 0, k, {0.3f, 0.3f}).ng) - unit));
        // And a ray through its middle meets it there, not somewhere along it.
        const Vec3d middle = (a + b + c) * (1.0 / 3.0);
        const Vec3f o = to_float(middle + unit * 2.0 + Vec3d{0.3, 0.2, 0.1});
        const Ray ray{o, normalize(to_float(middle - to_double(o)))};
        const Vec3d direction = to_double(ray.d);
        const double t = dot(a - to_double(ray.o), n) / dot(direction, n);
        if (!(std::fabs(dot(direction, unit)) > 0.3)) continue;
        rays_worst =
            std::max(rays_worst, length(to_double(surface_at<EffectSet::all()>(scene, ray, {0, k}).p) - to_double(ray.o) - direction * t));
    }
    INFO("worst error of a unit normal " << worst << ", of a point at distance 2 " << rays_worst);
    CHECK(worst < 5e-6);
    CHECK(rays_worst < 2e-3);
}

TEST_CASE("F9: a furnace of needles shows 2", "[hard][render]") {
    // Every face of the cube is cut into strips of 1 : 1e4 and worse, the longest of which have no digit of their width left in a float
    // product.
    std::vector<glm::vec3> positions;
    std::vector<std::array<std::uint32_t, 3>> triangles;
    const Matrix turn = rotated({0.6, 0.8, 0.0}, 37);
    constexpr int kStrips = 64;
    for (int face = 0; face < 6; ++face)
        for (int i = 0; i < kStrips; ++i) {
            const auto corner = [&](double s, double t) {
                glm::dvec3 p;
                p[face % 3] = face < 3 ? -1.0 : 1.0;
                p[(face + 1) % 3] = face < 3 ? t : s;
                p[(face + 2) % 3] = face < 3 ? s : t;
                positions.emplace_back(glm::dvec3(turn * glm::dvec4(p, 1)));
            };
            // Strips get thinner by a factor of 1.25 towards one side: 1 to 6e-7 of the face.
            const auto edge = [](int k) { return k == kStrips ? 1.0 : -1.0 + 2.0 * std::pow(0.8, kStrips - k) * (k > 0); };
            const auto base = static_cast<std::uint32_t>(positions.size());
            corner(-1, edge(i));
            corner(1, edge(i));
            corner(1, edge(i + 1));
            corner(-1, edge(i + 1));
            triangles.push_back({base, base + 1, base + 2});
            triangles.push_back({base, base + 2, base + 3});
        }
    SceneDescription d = furnace(mesh(positions, triangles), Matrix(1.0), 0.5f, 1.0f);
    d.shapes[0].flip_normals = true;
    d.shapes[0].face_normals = true;
    d.camera.to_world = translated({0.1, -0.2, 0.05});
    check_mean(measure(d, 1024, 8), 2.0, 1e-3);
}
