#pragma once
// The images that a report shows.

#include "bench_scene.h"

#include <string>

namespace koksma {

/// Renders a scene's whole film, small, into out/pictures. @return its path relative to out
[[nodiscard]] std::string render_picture(const Experiment& experiment, const BenchScene& scene, const Registry& registry, const std::filesystem::path& out,
                                         int threads);

/// A sampler's name without the characters that file systems dislike.
[[nodiscard]] std::string file_stem(std::string sampler);

}  // namespace koksma
