#include "bench_scene.h"
#include "progress.h"
#include "reference_store.h"

#include <koksma/film/atomic_file.h>

#include <fmt/format.h>

#include <cstdio>

namespace koksma {

namespace {

void print_third_opinion(const BenchScene& scene, const Reference& reference, const Experiment& experiment, const Registry& registry,
                         int threads) {
    Progress progress("check " + scene.what.name, true);
    const ThirdOpinion third = third_opinion(scene.scene, reference, reference.halves[0].spp, experiment.reference.replicates, registry,
                                             threads, [&](double f) { progress.update(f); });
    fmt::print(
        "{:<10} agrees with {}: largest z of an 8x8 block {:.2f} (limit {:.1f}). A bias of {:.2g} % of the mean in a typical block, "
        "or of {:.2g} % in the whole image, would have been seen\n",
        "", third.estimator, third.max_block_z, third.limit, 100 * third.block_bias, 100 * third.image_bias);
}

}  // namespace

int run_reference(const ReferenceCommand& command, const Registry& registry) {
    const Experiment experiment = load_experiment(command.experiment);
    const std::filesystem::path folder = command.out.empty() ? reference_cache() : command.out;
    std::error_code error;
    std::filesystem::create_directories(folder, error);
    if (error) throw Error(fmt::format("cannot make the folder {}: {}", folder.string(), error.message()));
    for (const BenchScene& scene : open_scenes(experiment, command.scenes)) {
        const std::filesystem::path file = folder / reference_file_name(scene.key);
        if (std::filesystem::exists(file) && !command.force) {
            const Reference old = load_reference(file, scene.key);
            fmt::print("{:<10} is there: {} (standard error {:.3e}, largest z between the halves {:.2f})\n", scene.what.name, file.string(),
                       old.standard_error(), require_agreement(old));
            std::fflush(stdout);
            if (command.check) print_third_opinion(scene, old, experiment, registry, command.threads);
            continue;
        }
        require_writable(file);
        Reference reference;
        {
            Progress progress("reference " + scene.what.name, true);
            reference = make_reference(
                scene.scene, scene.plan, scene.key, experiment, command.spp == 0 ? experiment.reference.spp : command.spp, registry,
                command.threads, [&](double f) { progress.update(f); }, steps_of(file));
        }
        save_reference(file, reference);
        fmt::print("{:<10} {} spp in two halves, standard error {:.3e}, largest z between the halves {:.2f}: {}\n", scene.what.name,
                   reference.spp_total(), reference.standard_error(), require_agreement(reference), file.string());
        if (command.check) print_third_opinion(scene, reference, experiment, registry, command.threads);
        std::fflush(stdout);
    }
    return 0;
}

}  // namespace koksma
