#include "commands.h"
#include "machine.h"
#include "scene_setup.h"

#include <koksma/film/atomic_file.h>
#include <koksma/film/exr.h>
#include <koksma/integrators/lecture/adaptive.h>

#include <fmt/format.h>

#include <algorithm>

namespace koksma {

int run_adaptive(const AdaptiveCommand& command, const Registry& registry) {
    if (command.output.extension() != ".exr")
        throw UsageError(fmt::format("--output '{}': images are OpenEXR; give a name that ends in .exr", command.output.string()));
    AdaptiveSettings settings;
    if (command.mode == "one-stage")
        settings.mode = AdaptiveMode::one_stage;
    else if (command.mode != "two-stage")
        throw UsageError(fmt::format("--mode '{}'; expected two-stage or one-stage", command.mode));
    require_writable(command.output);
    const SceneSetup setup = set_up(command.scene, registry);
    settings.average_spp = setup.spp;
    settings.seed = setup.seed;
    settings.most_spp = command.most;
    const AdaptiveResult result = render_adaptive(setup.scene, setup.plan, *setup.sampler, setup.rect(), settings, command.threads);

    ExrImage exr;
    exr.width = setup.rect().width;
    exr.height = setup.rect().height;
    exr.data_x = setup.rect().x;
    exr.data_y = setup.rect().y;
    exr.display_width = setup.scene.film.width;
    exr.display_height = setup.scene.film.height;
    exr.set_rgb(result.film.image());
    std::vector<float>& counts = exr.channels["samples"];
    for (const std::uint64_t n : result.counts) counts.push_back(static_cast<float>(n));
    exr.attributes = {{"koksma:version", version()},
                      {"koksma:commit", commit()},
                      {"koksma:scene", setup.scene.description.file},
                      {"koksma:sampler", setup.sampler->name()},
                      {"koksma:adaptive", command.mode},
                      {"koksma:spp", fmt::format("{}", result.spent_spp)},
                      {"koksma:seed", std::to_string(setup.seed)}};
    write_exr(command.output, exr);
    if (!command.quiet) {
        const auto [least, most] = std::minmax_element(result.counts.begin(), result.counts.end());
        fmt::print(
            "{:.2f} samples a pixel were traced, {} of them by the pilot{}; {} to {} a pixel besides; {} invalid (they count as zero)\n",
            result.spent_spp, settings.pilot_scrambles * settings.pilot_spp,
            settings.mode == AdaptiveMode::two_stage ? ", which is discarded" : "", *least, *most, result.invalid_samples);
    }
    return 0;
}

}  // namespace koksma
