#pragma once
// A lamp of every kind, to be tested against every material and medium.

#include "describe.h"

namespace koksma::testing {

enum class LampKind {
    rectangle,
    sphere,
    inward_sphere,
    disk,
    mesh,
    textured,
    point,
    spot,
    projector,
    directional,
    cylinder,
    inward_cylinder,
    constant,
    map,
    many
};
inline constexpr LampKind kLampKinds[] = {LampKind::rectangle, LampKind::sphere,      LampKind::inward_sphere, LampKind::disk,
                                          LampKind::mesh,      LampKind::textured,    LampKind::point,         LampKind::spot,
                                          LampKind::projector, LampKind::directional, LampKind::cylinder,      LampKind::inward_cylinder,
                                          LampKind::constant,  LampKind::map,         LampKind::many};
inline constexpr const char* kLampNames[] = {"rectangle",     "sphere",
                                             "inward sphere", "disk",
                                             "mesh",          "textured rectangle",
                                             "point",         "spot",
                                             "projector",     "directional",
                                             "cylinder",      "inward cylinder",
                                             "constant sky",  "environment map",
                                             "many lights"};

/// One from which the origin is lit, and seen.
inline void add_lamp(SceneDescription& d, LampKind kind) {
    // In the mirror direction of the camera, more or less.
    const Matrix at = translated({-1.2, 1.3, 0.1}) * rotated({0, 0, 1}, -40) * scaled(0.6) * kDown;
    switch (kind) {
        case LampKind::rectangle:
            add_light(d, RectangleShape{}, at, Rgb(2.0f));
            break;
        case LampKind::sphere:
            add_light(d, SphereShape{}, at, Rgb(2.0f));
            break;
        case LampKind::inward_sphere:
            add_light(d, SphereShape{}, translated({0.3, 0.2, -0.1}) * scaled(4), Rgb(0.5f)).flip_normals = true;
            break;
        case LampKind::disk:
            add_light(d, DiskShape{}, at * scaled({1.2, 0.7, 1}), Rgb(2.0f));
            break;
        case LampKind::mesh:
            add_light(d,
                      mesh({{-1, -1, 0}, {1, -1, 0}, {0.5f, 1, 0.3f}, {-1.5f, 0.5f, -0.2f}, {0, 0, 0}}, {{0, 1, 2}, {0, 2, 3}, {4, 4, 1}}),
                      at, Rgb(2.0f));
            break;
        case LampKind::textured: {
            BitmapTexture t;
            t.image = image(4, 2, {Rgb(0.0f), Rgb(4.0f), Rgb(1.0f), Rgb(9.0f), Rgb(0.2f), Rgb(3.0f), Rgb(0.0f), Rgb(7.0f)});
            t.wrap = BitmapTexture::Wrap::mirror;
            add_light(d, RectangleShape{}, at, t);
            break;
        }
        case LampKind::point:
            d.point_lights.push_back({{-1.2, 1.3, 0.1}, Rgb(2.0f), {}});
            break;
        case LampKind::spot: {
            SpotLight s;
            s.to_world = look_at({-1.2, 1.3, 0.1}, {0.2, 0, 0});
            s.intensity = Rgb(2.0f);
            s.beam_degrees = 1.0;
            d.delta_lights.push_back(s);
            break;
        }
        case LampKind::projector: {
            ProjectorLight p;
            p.to_world = look_at({-1.2, 1.3, 0.1}, {0.2, 0, 0});
            d.delta_lights.push_back(p);
            break;
        }
        case LampKind::directional:
            d.delta_lights.push_back(DirectionalLight{{1.2, -1.3, 0.2}, Rgb(2.0f), {}});
            break;
        case LampKind::cylinder:
            add_light(d, CylinderShape{{0, -0.6, 0}, {0.1, 0.6, 0.2}, 0.2}, translated({-1.2, 1.3, 0.1}), Rgb(2.0f));
            break;
        case LampKind::inward_cylinder:
            add_light(d, CylinderShape{{0, -3, 0}, {0.2, 3, 0.1}, 3.0}, Matrix(1.0), Rgb(0.5f)).flip_normals = true;
            break;
        case LampKind::constant:
            d.environment = ConstantEnvironment{};
            break;
        case LampKind::map: {
            MapEnvironment m;
            std::vector<Rgb> texels;
            for (int y = 0; y < 8; ++y)
                for (int x = 0; x < 16; ++x)
                    texels.emplace_back(x == 5 && y == 2 ? 20.0f : (x * y) % 5 == 0 ? 0.0f : 0.1f * static_cast<float>(x));
            m.image = image(16, 8, std::move(texels));
            m.to_world = rotated({0.6, 0.8, 0}, 50);
            d.environment = m;
            break;
        }
        case LampKind::many: {
            // A cloud of loose triangles, a grid of rectangles and a sky: the light tree with all that it tells apart.
            std::vector<glm::vec3> corners;
            std::vector<std::array<std::uint32_t, 3>> triangles;
            for (std::uint32_t i = 0; i < 24; ++i) {
                const auto x = static_cast<float>(i % 5), y = static_cast<float>(i % 7), z = static_cast<float>(i % 3);
                const glm::vec3 c(0.4f * x - 0.8f, 0.3f * y - 0.9f, 0.2f * z);
                corners.insert(corners.end(), {c, c + glm::vec3(0.2f, 0.02f * y, 0.05f * x), c + glm::vec3(0.05f * z, 0.25f, 0.03f * x)});
                triangles.push_back({3 * i, 3 * i + 1, 3 * i + 2});
            }
            add_light(d, mesh(corners, triangles), at, Rgb(6.0f));
            for (int i = 0; i < 9; ++i)
                add_light(d, RectangleShape{}, translated({0.4 * (i % 3), 1.5, 0.4 * (i / 3)}) * scaled(0.1) * kDown,
                          Rgb(1.0f + static_cast<float>(i)));
            d.environment = ConstantEnvironment{Rgb(0.1f), {}};
            break;
        }
    }
}

}  // namespace koksma::testing
