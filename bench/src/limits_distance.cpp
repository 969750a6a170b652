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

/// What one scene's measurement holds.
struct Distance {
    RayRecord record;              ///< the reference kernel's rays
    PacketRecord own{};            ///< the chosen kernel's packets
    bool has_own = false;
    std::vector<Contender> contenders{};  ///< the chosen kernel, and the reference kernel unless it is that
    std::vector<double> e1{}, e_own{}, own_over_e1{};
    bool same_answers = true;      ///< replayed rays met what the recorded ones met
    Answers own_answers{};
    double paths = 0.0;
};

std::vector<Contender> choose_contenders(const LimitsCommand& command, EffectSet effects) {
    std::vector<Contender> out(2);
    out[0].kernel = command.kernel.empty() ? &choose_kernel(effects) : &find_kernel(command.kernel, effects);
    for (const Kernel& k : kernels())
        if (out[1].kernel == nullptr && k.name.starts_with("reference/") && k.effects.contains(effects)) out[1].kernel = &k;
    if (out[0].kernel == out[1].kernel) out.pop_back();
    return out;
}

/// Replays and renders in turn. The first round warms up and is not kept.
void run_rounds(Distance& d, int rounds, const SceneSetup& setup, const SampleSource& source) {
    Progress progress("limits", true);
    for (int round = -1; round < rounds; ++round) {
        Answers answers;
        const double single = d.record.replay(setup.scene.accelerator, answers);
        d.same_answers = d.same_answers && answers == d.record.answers();
        d.own_answers = {};
        const double packets = d.has_own ? d.own.replay(setup.scene.accelerator, d.own_answers) : 0.0;
        if (round < 0) continue;
        d.e1.push_back(single);
        for (Contender& c : d.contenders) c.render(setup, source, single);
        if (d.has_own) {
            d.e_own.push_back(packets);
            d.own_over_e1.push_back(packets / single);
            d.contenders[0].over_own.push_back(d.contenders[0].cpu.back() / packets);
        }
        progress.update((round + 1.0) / rounds);
    }
}

void print_line(const std::string& what, const std::string& ns, const std::string& over_e1, const std::string& over_own, const std::string& share, const std::string& wall) {
    fmt::print("  {:<28}{:<24}{:<21}{:<21}{:<9}{}\n", what, ns, over_e1, over_own, share, wall);
}

/// The table and its figures.
Json tell(const Distance& d) {
    const Spread e1 = per_path(d.e1, d.paths), e_own = per_path(d.e_own, d.paths), own_over_e1 = spread_of(d.own_over_e1);
    print_line("", "CPU ns/path [min, max]", "T/E1", "T/Eown", "sampler", "wall ns/path");
    print_line("E1: rays one by one", text(e1, "{:.0f}"), "1", "", "", "");
    if (d.has_own) print_line("Eown: its own packets", text(e_own, "{:.0f}"), text(own_over_e1, "{:.3f}"), "1", "", "");
    Json kernels = Json::array();
    for (const Contender& c : d.contenders) {
        const Spread ns = per_path(c.cpu, d.paths), wall = per_path(c.wall, d.paths), over_e1 = spread_of(c.over_e1), over_own = spread_of(c.over_own);
        const double share = spread_of(c.sampler).median;
        print_line(std::string(c.kernel->name), text(ns, "{:.0f}"), text(over_e1, "{:.3f}"), c.over_own.empty() ? "" : text(over_own, "{:.3f}"),
                   fmt::format("{:.1f} %", 100.0 * share), fmt::format("{:.0f}", wall.median));
        Json row = {{"kernel", c.kernel->name},
                    {"cpu_ns_per_path", json_of(ns)},
                    {"wall_ns_per_path", json_of(wall)},
                    {"t_over_e1", json_of(over_e1)},
                    {"sampler_share", share},
                    {"closest_rays_per_path", static_cast<double>(c.rays.closest) / d.paths},
                    {"shadow_rays_per_path", static_cast<double>(c.rays.shadow) / d.paths}};
        if (!c.over_own.empty()) row["t_over_eown"] = json_of(over_own);
        kernels.push_back(std::move(row));
    }
    Json figures = {{"e1_ns_per_path", json_of(e1)}, {"kernels", kernels}};
    if (d.has_own) {
        figures["eown_ns_per_path"] = json_of(e_own);
        figures["eown_over_e1"] = json_of(own_over_e1);
    }
    return figures;
}

/// True if every kernel traced as many rays as were recorded.
bool tell_rays(const Distance& d) {
    const RayCounts recorded = d.record.rays();
    const auto a_path = [&](RayCounts r) { return fmt::format("{:.5f} closest, {:.5f} shadow", static_cast<double>(r.closest) / d.paths, static_cast<double>(r.shadow) / d.paths); };
    bool all_same = true;
    for (const Contender& c : d.contenders) {
        const bool same = nearly(c.rays.closest, recorded.closest) && nearly(c.rays.shadow, recorded.shadow);
        all_same = all_same && same;
        fmt::print("  rays per path: {} ({}){}\n", a_path(c.rays), c.kernel->name, same ? "" : "  NOT those of the reference kernel: " + a_path(recorded));
    }
    return all_same;
}

}  // namespace

Json measure_distance(const LimitsCommand& command, SceneSetup& setup, bool& ok) {
    const std::uint64_t most_bytes = command.memory_gb << 30;
    const std::unique_ptr<SampleSource> source = setup.bind();
    Distance d{RayRecord(setup.scene, setup.plan, *source, {setup.rect(), 0, setup.spp}, most_bytes), {}};
    d.paths = static_cast<double>(setup.rect().area()) * static_cast<double>(setup.spp);
    d.contenders = choose_contenders(command, setup.plan.effects);
    d.own = packets_of(setup, *source, *d.contenders[0].kernel, most_bytes);
    d.has_own = !d.own.empty() && d.own.complete();
    run_rounds(d, command.rounds, setup, *source);

    Json figures = tell(d);
    const bool same_rays = tell_rays(d);
    const bool same_hits = !d.has_own || (nearly(d.own_answers.closest_hits, d.record.answers().closest_hits) && nearly(d.own_answers.blocked, d.record.answers().blocked));
    if (!d.own.complete()) fmt::print("  T/Eown is left out: the packets need more than {} GB; lower --spp, use --crop or raise --memory\n", command.memory_gb);
    if (!d.same_answers) fmt::print("  REPLAYED RAYS MET SOMETHING ELSE than in the render: E1 is not to be trusted\n");
    if (!same_hits) fmt::print("  REPLAYED PACKETS MET SOMETHING ELSE than the reference kernel's rays: Eown is not to be trusted\n");
    const bool good = same_rays && d.same_answers && same_hits;
    if (!good) fmt::print(stderr, "koksma: {}: the kernels do not trace the same rays; their times say nothing\n", setup.scene.description.file);
    ok = ok && good;
    figures["same_rays"] = same_rays;
    figures["same_answers"] = d.same_answers && same_hits;
    return figures;
}

}  // namespace koksma
