#include "commands.h"
#include "limits.h"
#include "machine.h"

#include <koksma/film/atomic_file.h>
#include <koksma/simd/targets.h>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <fstream>

namespace koksma {

namespace {

SceneSetup open(const LimitsCommand& command, const std::filesystem::path& scene, const Registry& registry) {
    SceneArguments arguments = command.settings;
    arguments.scene = scene;
    if (!arguments.spp) arguments.spp = 16;
    SceneSetup setup = set_up(arguments, registry);
    if (!command.kernel.empty()) {
        try {
            static_cast<void>(find_kernel(command.kernel, setup.plan.effects));
        } catch (const Error& e) {
            throw UsageError(e.what());
        }
    }
    if (command.not_robust) setup.scene.accelerator.commit(false);
    return setup;
}

}  // namespace

int run_limits(const LimitsCommand& command, const Registry& registry) {
    if (!command.json.empty()) require_writable(command.json);
    const Machine m = machine();
    fmt::print("{}, {} cores, {}; packets of {}; {}{}\n", m.cpu, m.cores, m.compiler, simd::target(), Accelerator::version(),
               command.not_robust ? " WITHOUT its robust flag (diagnostic)" : "");
    nlohmann::ordered_json scenes = nlohmann::ordered_json::array();
    bool ok = true;
    for (const std::filesystem::path& file : command.scenes) {
        SceneSetup setup = open(command, file, registry);
        fmt::print("\n{}: {} triangles, {}x{} pixels, {} spp, max_depth {}, {}\n", setup.scene.description.file, setup.scene.triangles.size(), setup.rect().width,
                   setup.rect().height, setup.spp, setup.plan.integrator.max_depth, setup.sampler->name());
        nlohmann::ordered_json figures = command.scaling  ? measure_scaling(command, setup)
                                         : command.growth ? measure_growth(command, setup)
                                                          : measure_distance(command, setup, ok);
        nlohmann::ordered_json row = {{"scene", setup.scene.description.file},
                                      {"scene_hash", fmt::format("{:016x}", setup.scene.description.hash)},
                                      {"triangles", setup.scene.triangles.size()},
                                      {"film", {setup.scene.film.width, setup.scene.film.height}},
                                      {"crop", {setup.rect().x, setup.rect().y, setup.rect().width, setup.rect().height}},
                                      {"spp", setup.spp},
                                      {"sampler", setup.sampler->name()},
                                      {"max_depth", setup.plan.integrator.max_depth},
                                      {"rr_depth", setup.plan.integrator.rr_depth}};
        row.update(figures);
        scenes.push_back(std::move(row));
    }
    if (!command.json.empty()) {
        const nlohmann::ordered_json all = {{"measures", command.scaling ? "scaling" : command.growth ? "growth" : "distance"},
                                            {"commit", commit()},
                                            {"cpu", m.cpu},
                                            {"cores", m.cores},
                                            {"isa", m.isa},
                                            {"compiler", m.compiler},
                                            {"simd_target", simd::target()},
                                            {"embree", Accelerator::version()},
                                            {"robust", !command.not_robust},
                                            {"rounds", command.rounds},
                                            {"scenes", scenes}};
        write_atomically(command.json, [&](const std::filesystem::path& file) {
            std::ofstream out(file);
            out << all.dump(2) << '\n';
            out.flush();
            if (!out) throw Error("the disk is full or the folder is not writable");
        });
    }
    return ok ? 0 : 1;
}

}  // namespace koksma
