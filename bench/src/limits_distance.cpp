#include "limits.h"
#include "progress.h"
#include "ray_record.h"
#include "spread.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <cstdio>

namespace koksma {

namespace {

using Json = nlohmann::ordered_json;

Json json_of(const Spread& s) { return {{"median", s.median}, {"min", s.lowest}, {"max", s.highest}}; }

/// The rounds of one kernel.
struct Contender {
    const Kernel* kernel = nullptr;
    std::vector<double> cpu, wall, over_e1, over_own, sampler;
    RayCounts rays;

    void render(const SceneSetup& setup, const SampleSource& source, double e1) {
        RenderOptions o;
        o.threads = 1;
        o.kernel = kernel;
        const RenderStats s = koksma::render(setup.scene, setup.plan, source, {setup.rect(), 0, setup.spp}, o).stats;
        cpu.push_back(s.cpu_seconds);
        wall.push_back(s.wall_seconds);
        over_e1.push_back(s.cpu_seconds / e1);
        sampler.push_back(s.sampler_seconds / s.cpu_seconds);
        rays = s.rays;
    }
};

Spread per_path(std::vector<double> seconds, double paths) {
    for (double& s : seconds) s *= 1e9 / paths;
    return spread_of(std::move(seconds));
}

std::string text(const Spread& s, const char* format) {
    return fmt::format("{} [{}, {}]", fmt::format(fmt::runtime(format), s.median), fmt::format(fmt::runtime(format), s.lowest),
                       fmt::format(fmt::runtime(format), s.highest));
}

/// The packets of a render with this kernel.
PacketRecord packets_of(SceneSetup& setup, const SampleSource& source, const Kernel& kernel, std::uint64_t most_bytes) {
    PacketRecord record;
    setup.scene.accelerator.watch([&](const PacketQuery& q) { record.add(q, most_bytes); });
    RenderOptions o;
    o.threads = 1;
    o.kernel = &kernel;
    static_cast<void>(render(setup.scene, setup.plan, source, {setup.rect(), 0, setup.spp}, o));
    setup.scene.accelerator.watch({});
    return record;
}

bool nearly(std::uint64_t a, std::uint64_t b) {
    return std::fabs(static_cast<double>(a) - static_cast<double>(b)) <= 1e-4 * static_cast<double>(b);
}

void print_line(const std::string& what, const std::string& ns, const std::string& over_e1, const std::string& over_own, const std::string& share, const std::string& wall) {
    fmt::print("  {:<28}{:<24}{:<21}{:<21}{:<9}{}\n", what, ns, over_e1, over_own, share, wall);
}

}  // namespace

Json measure_distance(const LimitsCommand& command, SceneSetup& setup, bool& ok) {
    const std::uint64_t most_bytes = command.memory_gb << 30;
    const std::unique_ptr<SampleSource> source = setup.bind();
    const Accelerator& accelerator = setup.scene.accelerator;
    const RayRecord record(setup.scene, setup.plan, *source, {setup.rect(), 0, setup.spp}, most_bytes);

    std::vector<Contender> contenders(2);
    contenders[0].kernel = command.kernel.empty() ? &choose_kernel(setup.plan.effects) : &find_kernel(command.kernel, setup.plan.effects);
    for (const Kernel& k : kernels())
        if (contenders[1].kernel == nullptr && k.name.starts_with("reference/") && k.effects.contains(setup.plan.effects)) contenders[1].kernel = &k;
    if (contenders[0].kernel == contenders[1].kernel) contenders.pop_back();
    const PacketRecord own = packets_of(setup, *source, *contenders[0].kernel, most_bytes);
    const bool has_own = !own.empty() && own.complete();

    std::vector<double> e1, e_own, own_over_e1;
    bool same_answers = true;
    Answers own_answers;
    {
        Progress progress("limits", true);
        for (int round = -1; round < command.rounds; ++round) {  // the first one warms up
            Answers answers;
            const double single = record.replay(accelerator, answers);
            same_answers = same_answers && answers == record.answers();
            own_answers = {};
            const double packets = has_own ? own.replay(accelerator, own_answers) : 0.0;
            if (round < 0) continue;
            e1.push_back(single);
            for (Contender& c : contenders) c.render(setup, *source, single);
            if (has_own) {
                e_own.push_back(packets);
                own_over_e1.push_back(packets / single);
                contenders[0].over_own.push_back(contenders[0].cpu.back() / packets);
            }
            progress.update((round + 1.0) / command.rounds);
        }
    }

    const double paths = static_cast<double>(setup.rect().area()) * static_cast<double>(setup.spp);
    print_line("", "CPU ns/path [min, max]", "T/E1", "T/Eown", "sampler", "wall ns/path");
    print_line("E1: rays one by one", text(per_path(e1, paths), "{:.0f}"), "1", "", "", "");
    if (has_own) print_line("Eown: its own packets", text(per_path(e_own, paths), "{:.0f}"), text(spread_of(own_over_e1), "{:.3f}"), "1", "", "");
    Json kernels = Json::array();
    for (const Contender& c : contenders) {
        const Spread ns = per_path(c.cpu, paths), wall = per_path(c.wall, paths), d1 = spread_of(c.over_e1), own_ratio = spread_of(c.over_own), share = spread_of(c.sampler);
        print_line(std::string(c.kernel->name), text(ns, "{:.0f}"), text(d1, "{:.3f}"), c.over_own.empty() ? "" : text(own_ratio, "{:.3f}"),
                   fmt::format("{:.1f} %", 100.0 * share.median), fmt::format("{:.0f}", wall.median));
        Json row = {{"kernel", c.kernel->name},
                    {"cpu_ns_per_path", json_of(ns)},
                    {"wall_ns_per_path", json_of(wall)},
                    {"t_over_e1", json_of(d1)},
                    {"sampler_share", share.median},
                    {"closest_rays_per_path", static_cast<double>(c.rays.closest) / paths},
                    {"shadow_rays_per_path", static_cast<double>(c.rays.shadow) / paths}};
        if (!c.over_own.empty()) row["t_over_eown"] = json_of(own_ratio);
        kernels.push_back(std::move(row));
    }

    bool same_rays = true;
    for (const Contender& c : contenders) {
        const bool same = nearly(c.rays.closest, record.rays().closest) && nearly(c.rays.shadow, record.rays().shadow);
        same_rays = same_rays && same;
        fmt::print("  rays per path: {:.5f} closest, {:.5f} shadow ({}){}\n", static_cast<double>(c.rays.closest) / paths, static_cast<double>(c.rays.shadow) / paths,
                   c.kernel->name, same ? "" : fmt::format("  NOT those of the reference kernel: {:.5f}, {:.5f}", static_cast<double>(record.rays().closest) / paths,
                                                          static_cast<double>(record.rays().shadow) / paths));
    }
    const bool same_hits = !has_own || (nearly(own_answers.closest_hits, record.answers().closest_hits) && nearly(own_answers.blocked, record.answers().blocked));
    if (!own.complete()) fmt::print("  T/Eown is left out: the packets need more than {} GB; lower --spp, use --crop or raise --memory\n", command.memory_gb);
    if (!same_answers) fmt::print("  REPLAYED RAYS MET SOMETHING ELSE than in the render: E1 is not to be trusted\n");
    if (!same_hits) fmt::print("  REPLAYED PACKETS MET SOMETHING ELSE than the reference kernel's rays: Eown is not to be trusted\n");
    ok = ok && same_rays && same_answers && same_hits;
    if (!ok) fmt::print(stderr, "koksma: {}: the kernels do not trace the same rays; their times say nothing\n", setup.scene.description.file);

    Json figures = {{"e1_ns_per_path", json_of(per_path(e1, paths))}, {"kernels", kernels}, {"same_rays", same_rays}, {"same_answers", same_answers && same_hits}};
    if (has_own) {
        figures["eown_ns_per_path"] = json_of(per_path(e_own, paths));
        figures["eown_over_e1"] = json_of(spread_of(own_over_e1));
    }
    return figures;
}

}  // namespace koksma
