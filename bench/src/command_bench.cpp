#include "bench_scene.h"
#include "judge.h"
#include "line_file.h"
#include "machine.h"
#include "measure.h"
#include "pictures.h"
#include "png.h"
#include "progress.h"
#include "reference_store.h"
#include "report.h"
#include "row.h"
#include "scene_setup.h"

#include <koksma/film/atomic_file.h>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <set>

namespace koksma {

namespace {

using Json = nlohmann::ordered_json;

Json header_json(const Experiment& e, const std::vector<std::unique_ptr<SamplerFactory>>& samplers, const std::string& command_line, int threads) {
    const Machine m = machine();
    Json labels = Json::array();
    for (const auto& s : samplers) {
        std::string label = s->info().title;
        if (s->options().has("randomize")) label += " (" + s->options()["randomize"] + ")";
        labels.push_back({{"sampler", s->name()}, {"label", label}, {"version", s->info().version}});
        if (e.own_counts) labels.back()["own_counts"] = own_counts(e, s->info());
    }
    return {{"kind", "header"},
            {"experiment",
             {{"name", e.name},
              {"title", e.title},
              {"command", command_line},
              {"commit", commit()},
              {"machine", m.cpu},
              {"cores", m.cores},
              {"isa", m.isa},
              {"compiler", m.compiler},
              {"threads", threads > 0 ? threads : m.cores},
              {"version", version()},
              {"note", ""}}},
            {"samplers", labels},
            {"relmse_targets", e.targets},
            {"crop_spp", e.crop_spp},
            {"layouts", e.layouts},
            {"any_count", e.own_counts},
            {"scenes", Json::array()}};
}

Reference obtain_reference(const Experiment& e, const BenchScene& s, const Registry& registry, int threads) {
    if (const auto file = find_reference(s.key)) {
        Reference reference = load_reference(*file, s.key);
        require_agreement(reference);
        return reference;
    }
    const std::filesystem::path file = reference_cache() / reference_file_name(s.key);
    std::error_code ignored;
    std::filesystem::create_directories(file.parent_path(), ignored);
    require_writable(file);
    fmt::print(stderr, "koksma: there is no reference for {} yet; rendering it (kept in {})\n", s.what.name, file.parent_path().string());
    Progress progress("reference " + s.what.name, true);
    Reference reference = make_reference(s.scene, s.plan, s.key, e, e.reference.spp, registry, threads, [&](double f) { progress.update(f); });
    save_reference(file, reference);
    return reference;
}

Json scene_json(const BenchScene& s, const Judge& judge) {
    const Reference& reference = judge.reference();
    const Errors halves = judge.between_halves();
    const auto file = find_reference(s.key);
    return {{"name", s.what.name},
            {"purpose", s.scene.description.purpose},
            {"expect", s.scene.description.expect},
            {"film", {s.scene.film.width, s.scene.film.height}},
            {"crop", {s.what.crop.x, s.what.crop.y, s.what.crop.width, s.what.crop.height}},
            {"max_depth", s.plan.integrator.max_depth},
            {"rr_depth", s.plan.integrator.rr_depth},
            {"reference",
             {{"samplers", {reference.halves[0].sampler, reference.halves[1].sampler}},
              {"spp_total", reference.spp_total()},
              {"replicates", reference.halves[0].replicates + reference.halves[1].replicates},
              {"se_rmse", reference.standard_error()},
              {"halves_z", require_agreement(reference)},
              {"between_halves", {{"mae", halves.mae}, {"smape", halves.smape}, {"flip", halves.flip}}},
              {"file", file ? file->filename().string() : ""}}},
            {"emitter_pixels", judge.emitter_pixels()},
            {"picture", nullptr},
            {"reference_crop", nullptr},
            {"crops", Json::object()}};
}

/// Every number of samples that some sampler is run at, increasing.
std::vector<std::uint64_t> all_spp(const std::vector<std::vector<Count>>& counts) {
    std::set<std::uint64_t> all;
    for (const std::vector<Count>& of_sampler : counts)
        for (const Count& c : of_sampler) all.insert(c.spp);
    return {all.begin(), all.end()};
}

/// 0 where the sampler is not run at this count.
int replicates_at(const std::vector<Count>& counts, std::uint64_t spp) {
    for (const Count& c : counts)
        if (c.spp == spp) return c.replicates;
    return 0;
}

}  // namespace

int run_bench(const BenchCommand& command, const Registry& registry, const std::string& command_line) {
    Experiment experiment = load_experiment(command.experiment);
    if (command.quick) experiment = quick(experiment);
    if (!command.samplers.empty()) experiment.samplers = command.samplers;
    std::vector<std::unique_ptr<SamplerFactory>> samplers;
    for (const std::string& spec : experiment.samplers) {
        samplers.push_back(make_sampler(registry, spec));
        for (std::size_t i = 0; i + 1 < samplers.size(); ++i)  // its renders would count twice, as replicates that they are not
            if (samplers[i]->name() == samplers.back()->name()) throw UsageError(fmt::format("sampler {} is asked for twice", samplers[i]->name()));
    }
    const std::vector<BenchScene> scenes = open_scenes(experiment, command.scenes);
    for (const BenchScene& s : scenes)
        for (const auto& sampler : samplers)  // a limit is told now, not after an hour
            static_cast<void>(sampler->bind(sampling_plan(s.scene, s.plan, experiment.spp.back(), 0)));
    std::vector<std::vector<SlotOrder>> orders;
    for (const BenchScene& s : scenes) orders.push_back(slot_orders(s.plan.layout, static_cast<std::size_t>(experiment.layouts)));
    if (command.dry_run) {
        print_price(experiment, scenes, samplers, registry, command.threads);
        return 0;
    }

    const std::filesystem::path out = command.out.empty() ? std::filesystem::path("koksma-bench") / experiment.name : command.out;
    std::error_code error;
    std::filesystem::create_directories(out / "pictures", error);
    if (error) throw Error(fmt::format("cannot make the folder {}: {}", (out / "pictures").string(), error.message()));
    require_writable(out / "results.jsonl");

    std::vector<Reference> references;
    for (const BenchScene& s : scenes) references.push_back(obtain_reference(experiment, s, registry, command.threads));

    // The rows go to a file of their own, which takes the old one's place when all are there.
    const std::filesystem::path rows_file = out / "results.jsonl";
    Json header = header_json(experiment, samplers, command_line, command.threads);
    std::vector<Json> rows;
    LineFile partial(out / "results.partial.jsonl");
    {
        Progress progress("bench", true);
        std::vector<std::vector<Count>> counts;
        std::uint64_t per_scene = 0;
        for (const auto& sampler : samplers) {
            counts.push_back(counts_of(experiment, sampler->info()));
            per_scene += amount_of(experiment, *sampler).paths_per_pixel;
        }
        double done = 0.0;
        for (std::size_t i = 0; i < scenes.size(); ++i) {
            const BenchScene& s = scenes[i];
            const Reference& reference = references[i];
            const Judge judge(s, reference, registry, command.threads);
            Json entry = scene_json(s, judge);
            entry["picture"] = render_picture(experiment, s, registry, out, command.threads);
            const float exposure = exposure_for(reference.mean);
            entry["reference_crop"] = "pictures/" + s.what.name + "-reference.png";
            write_png(out / entry["reference_crop"].get<std::string>(), reference.mean, s.what.crop.width, s.what.crop.height, exposure);
            // Samplers take turns within a replicate: what slows the machine down slows all of them.
            const int most = *std::max_element(experiment.replicates.begin(), experiment.replicates.end());
            for (int replicate = 0; replicate < most; ++replicate)
                for (const std::uint64_t spp : all_spp(counts))
                    for (std::size_t k = 0; k < samplers.size(); ++k) {
                        const SamplerFactory& sampler = *samplers[k];
                        if (replicate >= replicates_at(counts[k], spp)) continue;
                        if (replicate > 0 && !sampler.randomized()) continue;  // it would be the same render again
                        for (std::size_t layout = 0; layout < orders[i].size(); ++layout) {
                            std::vector<float> image;
                            const Trial trial{spp, replicate, static_cast<int>(layout), &orders[i][layout]};
                            rows.push_back(measure(s, sampler, judge, trial, experiment.seed, command.threads, image));
                            partial.add(rows.back());
                            if (replicate == 0 && layout == 0 && spp == experiment.crop_spp) {
                                const std::string name = "pictures/" + s.what.name + "-" + file_stem(sampler.name()) + ".png";
                                write_png(out / name, image, s.what.crop.width, s.what.crop.height, exposure);
                                entry["crops"][sampler.name()] = name;
                            }
                            done += static_cast<double>(spp);
                            progress.update(done / (static_cast<double>(per_scene) * static_cast<double>(scenes.size())), s.what.name);
                        }
                    }
            header["scenes"].push_back(entry);
        }
    }
    write_atomically(rows_file, [&](const std::filesystem::path& file) {
        LineFile lines(file);
        lines.add(header);
        for (const Json& row : rows) lines.add(row);
    });
    std::filesystem::remove(out / "results.partial.jsonl", error);

    write_summary(out);
    fmt::print("\nrows:   {}\n", rows_file.string());
    if (command.no_report) return 0;
    if (std::string why_not; make_report(out, why_not))
        fmt::print("report: {}\n", (out / "report.html").string());
    else
        fmt::print(stderr, "koksma: the rows and the tables are complete, but there is no report.html: {}\n", why_not);
    return 0;
}

}  // namespace koksma
