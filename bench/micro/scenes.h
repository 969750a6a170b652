#pragma once
// Scenes for benchmarks: the everyday box, and half a million triangles.

#include <koksma/scene/load.h>
#include <koksma/scene/scene.h>

#include <glm/gtc/matrix_transform.hpp>

#include <cmath>
#include <filesystem>
#include <memory>

namespace koksma::micro {

[[nodiscard]] inline Scene cornell() { return compile(load_scene(std::filesystem::path(KOKSMA_SOURCE_DIR) / "scenes/cornell.xml", {{"res", "256"}})); }

/// 524 288 triangles below the camera.
[[nodiscard]] inline Scene hills() {
    constexpr int kSide = 512;
    auto data = std::make_shared<MeshData>();
    for (int j = 0; j <= kSide; ++j)
        for (int i = 0; i <= kSide; ++i) {
            const float x = 8.0f * static_cast<float>(i) / kSide - 4.0f, z = 8.0f * static_cast<float>(j) / kSide - 4.0f;
            data->positions.push_back({x, 0.3f * std::sin(2.0f * x + z) * std::cos(3.0f * z - x) + 0.05f * std::sin(17.0f * x) * std::cos(19.0f * z), z});
        }
    for (std::uint32_t j = 0; j < kSide; ++j)
        for (std::uint32_t i = 0; i < kSide; ++i) {
            const std::uint32_t a = j * (kSide + 1) + i, b = a + kSide + 1;
            data->triangles.push_back({a, b, a + 1});
            data->triangles.push_back({a + 1, b, b + 1});
        }
    SceneDescription d;
    d.materials.emplace_back();
    d.materials[0].front = Diffuse{};
    d.film = {256, 256};
    // The camera looks along +z of its own space.
    d.camera.to_world = glm::inverse(glm::lookAt(glm::dvec3(0.5, 2.6, 6.5), glm::dvec3(0, -0.2, 0), glm::dvec3(0, 1, 0))) *
                        glm::scale(glm::dmat4(1.0), glm::dvec3(-1, 1, -1));
    d.camera.near_clip = 0.01;
    d.camera.far_clip = 1000;
    Shape shape;
    shape.geometry = MeshShape{std::move(data)};
    d.shapes.push_back(std::move(shape));
    d.environment = ConstantEnvironment{};
    return compile(d);
}

}  // namespace koksma::micro
