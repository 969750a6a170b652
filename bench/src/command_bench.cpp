#include "bench_scene.h"
#include "judge.h"
#include "machine.h"
#include "obtain_reference.h"
#include "pictures.h"
#include "png.h"
#include "progress.h"
#include "price.h"
#include "reference_store.h"
#include "replicate_images.h"
#include "report.h"
#include "row_store.h"
#include "scene_setup.h"
#include "summary_images.h"
#include "trials.h"

#include <koksma/film/atomic_file.h>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

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
            {"progressive", e.progressive},
            {"scenes", Json::array()}};
}

Json predictions_of(const BenchScene& s, const Registry& registry) {
    return predictions_json(s.what.predictions, [&](const std::string& spec) { return make_sampler(registry, spec)->name(); });
}

Json scene_json(const BenchScene& s, const Judge& judge, const Registry& registry) {
    const Reference& reference = judge.reference();
    const Errors halves = judge.between_halves();
    const auto file = find_reference(s.key);
    return {{"name", s.what.name},
            {"effects_of", s.what.effects == "needed" ? Json() : Json(s.what.file.stem().string())},
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
            {"predictions", predictions_of(s, registry)},
            {"emitter_pixels", judge.emitter_pixels()},
            {"picture", nullptr},
            {"reference_crop", nullptr},
            {"crops", Json::object()}};
}

Run open_run(const BenchCommand& command, const Registry& registry) {
    Run run;
    run.experiment = load_experiment(command.experiment);
    if (command.quick) run.experiment = quick(run.experiment);
    if (!command.samplers.empty()) run.experiment.samplers = command.samplers;
    for (const std::string& spec : run.experiment.samplers) {
        run.samplers.push_back(make_sampler(registry, spec));
        for (std::size_t i = 0; i + 1 < run.samplers.size(); ++i)  // its renders would count twice, as replicates that they are not
            if (run.samplers[i]->name() == run.samplers.back()->name()) throw UsageError(fmt::format("sampler {} is asked for twice", run.samplers[i]->name()));
    }
    run.scenes = open_scenes(run.experiment, command.scenes);
    for (const BenchScene& s : run.scenes) {  // a limit or a sampler that there is not is told now, not after an hour
        static_cast<void>(predictions_of(s, registry));
        for (const auto& sampler : run.samplers) static_cast<void>(sampler->bind(sampling_plan(s.scene, s.plan, run.experiment.spp.back(), 0)));
    }
    for (const BenchScene& s : run.scenes) run.orders.push_back(slot_orders(s.plan.layout, static_cast<std::size_t>(run.experiment.layouts)));
    return run;
}

/// Renders what the store has not. @return  the rows of all trials, in their order
std::vector<Json> render_trials(const Run& run, const std::vector<PlannedTrial>& trials, const std::vector<Judge>& judges, RowStore& store, const std::filesystem::path& out,
                                int threads) {
    const Experiment& e = run.experiment;
    std::vector<Json> rows;
    std::size_t kept = 0, other_commit = 0;
    Progress progress("bench", true);
    double done = 0.0;
    const double all = samples_of(trials);
    for (const PlannedTrial& t : trials) {
        const BenchScene& s = run.scenes[t.scene];
        const SamplerFactory& sampler = *run.samplers[t.sampler];
        const Row expected = identity_of(s, sampler, judges[t.scene], t.trial, e.seed, threads);
        const bool image_kept = t.trial.layout == 0 && t.trial.prefix_of == 0 && t.trial.spp == e.crop_spp;
        const Json* earlier = store.find(key_of(expected));
        if (earlier != nullptr && (!image_kept || load_replicate(out, expected))) {
            rows.push_back(*earlier);
            ++kept;
            other_commit += earlier->at("commit") != expected.commit;
        } else {
            std::vector<float> image;
            const Row row = measure(s, sampler, judges[t.scene], t.trial, e.seed, threads, image);
            if (image_kept) save_replicate(out, row, image);  // before its row, so that no row is without
            store.add(row);
            rows.emplace_back(row);
        }
        done += static_cast<double>(t.trial.spp);
        progress.update(done / all, s.what.name);
    }
    if (kept > 0)
        fmt::print("{} of {} rows are from earlier runs in this folder{}; --fresh renders them again\n", kept, rows.size(),
                   other_commit > 0 ? fmt::format(" ({} of another commit of the program: their times may be out of date)", other_commit) : "");
    return rows;
}

/// Pictures of a scene's crops: of the reference, and of the first replicate of each sampler.
void write_crops(Json& entry, const BenchScene& s, const Reference& reference, const std::vector<Json>& rows, std::uint64_t crop_spp, const std::filesystem::path& out) {
    const float exposure = exposure_for(reference.mean);
    entry["reference_crop"] = "pictures/" + s.what.name + "-reference.png";
    write_png(out / entry["reference_crop"].get<std::string>(), reference.mean, s.what.crop.width, s.what.crop.height, exposure);
    for (const Json& json : rows) {
        if (json.at("scene") != s.what.name || json.at("replicate") != 0 || json.at("layout") != 0 || json.value("prefix_of", 0) != 0 ||
            json.at("spp") != crop_spp)
            continue;
        const Row row = json.get<Row>();
        const auto image = load_replicate(out, row);
        if (!image) continue;
        const std::string name = "pictures/" + s.what.name + "-" + file_stem(row.sampler) + ".png";
        write_png(out / name, *image, s.what.crop.width, s.what.crop.height, exposure);
        entry["crops"][row.sampler] = name;
    }
}

void make_folders(const std::filesystem::path& out) {
    for (const char* name : {"pictures", "images"}) {
        std::error_code error;
        std::filesystem::create_directories(out / name, error);
        if (error) throw Error(fmt::format("cannot make the folder {}: {}", (out / name).string(), error.message()));
    }
}

}  // namespace

void write_results(const std::filesystem::path& out, const Json& header, const std::vector<Json>& rows) {
    // The old file stays until the new one is whole.
    write_atomically(out / "results.jsonl", [&](const std::filesystem::path& file) {
        LineFile lines(file);
        lines.add(header);
        for (const Json& row : rows) lines.add(row);
    });
}

int finish_results(const std::filesystem::path& out, bool no_report) {
    write_summary(out);
    fmt::print("\nrows:   {}\n", (out / "results.jsonl").string());
    if (no_report) return 0;
    std::string why_not;
    if (!make_report(out, why_not)) throw Error("the rows and the tables are complete, but there is no report.html: " + why_not);
    return 0;  // the package has printed where the report is
}

int run_bench(const BenchCommand& command, const Registry& registry, const std::string& command_line) {
    const Shard shard = command.shard.empty() ? Shard{} : shard_of(command.shard);
    const Run run = open_run(command, registry);
    const std::vector<PlannedTrial> trials = trials_of(run, shard);
    std::filesystem::path out = command.out.empty() ? std::filesystem::path("koksma-bench") / run.experiment.name : command.out;
    if (shard.of > 1) out /= fmt::format("shard-{}-of-{}", shard.part, shard.of);
    if (command.dry_run) {
        print_price(run, trials, registry, out, command.fresh, command.threads);
        return 0;
    }
    if (trials.empty()) throw UsageError(fmt::format("--shard {}: there are fewer renders than shards", command.shard));
    make_folders(out);
    require_writable(out / "results.jsonl");

    std::vector<Reference> references;
    std::vector<Judge> judges;
    for (const BenchScene& s : run.scenes) references.push_back(obtain_reference(run.experiment, s, registry, command.threads));
    for (std::size_t i = 0; i < run.scenes.size(); ++i) judges.emplace_back(run.scenes[i], references[i], registry, command.threads);

    Json header = header_json(run.experiment, run.samplers, command_line, command.threads);
    header["shard"] = {shard.part, shard.of};
    header["trials"] = trials_of(run, {}).size();
    RowStore store(out, command.fresh);
    std::vector<Json> rows;
    try {
        rows = render_trials(run, trials, judges, store, out, command.threads);
        for (std::size_t i = 0; i < run.scenes.size(); ++i) {
            Json entry = scene_json(run.scenes[i], judges[i], registry);
            if (shard.part == 1) entry["picture"] = render_picture(run.experiment, run.scenes[i], registry, out, command.threads);
            save_reference_images(out, run.scenes[i].what.name, references[i]);
            write_crops(entry, run.scenes[i], references[i], rows, run.experiment.crop_spp, out);
            header["scenes"].push_back(entry);
        }
    } catch (const std::exception& e) {
        const std::size_t kept = store.give_up();
        if (kept == 0) throw;
        throw Error(fmt::format("{}; {} rows are kept in {}, and the same command goes on from there", e.what(), kept, store.partial_file().string()));
    }
    write_results(out, header, rows);
    store.finish();
    if (shard.of == 1) return finish_results(out, command.no_report);
    // A part has rows and pictures; tables and a report are for the whole.
    fmt::print("rows:   {}\nwhen all {} parts are there: koksma merge FOLDER... -o OUT\n", (out / "results.jsonl").string(), shard.of);
    return 0;
}

}  // namespace koksma
