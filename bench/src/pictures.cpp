#include "pictures.h"

#include "png.h"

namespace koksma {

std::string file_stem(std::string sampler) {
    for (char& c : sampler)
        if (c == ':' || c == '=' || c == ',' || c == '/') c = '-';
    return sampler;
}

std::string render_picture(const Experiment& e, const BenchScene& s, const Registry& registry, const std::filesystem::path& out, int threads) {
    SceneDescription description = load_scene(s.what.file);
    FilmSettings& film = description.film;
    const double scale = static_cast<double>(e.picture_size) / std::max(film.width, film.height);
    film = {std::max(1, static_cast<int>(film.width * scale)), std::max(1, static_cast<int>(film.height * scale)), 0, 0, 0, 0, film.filter};
    const Scene scene = compile(description);
    const RenderPlan plan = make_plan(scene, description.integrator);
    const auto source = registry.make(registry.contains("sobol") ? "sobol" : "random")->bind(sampling_plan(scene, plan, e.picture_spp, 0));
    RenderOptions options;
    options.threads = threads;
    const RenderResult result = render(scene, plan, *source, {crop_of(scene.film), 0, e.picture_spp}, options);
    const std::vector<float> image = result.film.image();
    const std::string name = "pictures/" + s.what.name + ".png";
    write_png(out / name, image, scene.film.width, scene.film.height, exposure_for(image));
    return name;
}

}  // namespace koksma
