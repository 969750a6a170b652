#include "bench_scene.h"
#include "machine.h"
#include "png.h"
#include "progress.h"
#include "reference_store.h"
#include "report.h"
#include "row.h"
#include "scene_setup.h"

#include <koksma/film/atomic_file.h>
#include <koksma/measure/metrics.h>
#include <koksma/measure/seeds.h>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <numeric>

namespace koksma {

namespace {

using Json = nlohmann::ordered_json;

/// Appends whole lines: each is one write, so a file never holds half of one.
class LineFile {
public:
    explicit LineFile(std::filesystem::path file) : file_(std::move(file)), descriptor_(::open(file_.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_APPEND | O_CLOEXEC, 0644)) {
        if (descriptor_ < 0) throw Error(fmt::format("cannot write {}: {}", file_.string(), std::strerror(errno)));
    }
    ~LineFile() { ::close(descriptor_); }
    LineFile(const LineFile&) = delete;
    LineFile& operator=(const LineFile&) = delete;
    void add(const Json& json) {
        const std::string line = json.dump() + "\n";
        const off_t before = ::lseek(descriptor_, 0, SEEK_END);
        const ssize_t written = ::write(descriptor_, line.data(), line.size());
        if (written == static_cast<ssize_t>(line.size())) return;
        const int error = written < 0 ? errno : ENOSPC;
        if (::ftruncate(descriptor_, before) != 0) throw Error(fmt::format("cannot write {}, and its last line may be incomplete", file_.string()));
        throw Error(fmt::format("cannot write {}: {}; earlier rows are intact", file_.string(), std::strerror(error)));
    }

private:
    std::filesystem::path file_;
    int descriptor_;
};

std::uint64_t paths_per_pixel(const Experiment& e) {
    std::uint64_t n = 0;
    for (std::size_t i = 0; i < e.spp.size(); ++i) n += e.spp[i] * static_cast<std::uint64_t>(e.replicates[i]);
    return n;
}

/// Seconds of CPU time a path, from a small render.
double seconds_per_path(const BenchScene& s, const Registry& registry, int threads) {
    const auto source = registry.make("random")->bind(sampling_plan(s.scene, s.plan, 16, 0));
    RenderOptions options;
    options.threads = threads;
    const RenderStats stats = render(s.scene, s.plan, *source, {s.what.crop, 0, 16}, options).stats;
    return stats.cpu_seconds / static_cast<double>(stats.paths);
}

int price(const Experiment& experiment, const std::vector<BenchScene>& scenes, const Registry& registry, int threads) {
    const int cores = threads > 0 ? threads : machine().cores;
    double total = 0.0;
    fmt::print("{:<10}{:>12}{:>14}{:>12}{:>14}  reference\n", "scene", "renders", "paths", "ns/path", "CPU seconds");
    const auto runs = std::accumulate(experiment.replicates.begin(), experiment.replicates.end(), std::size_t{0}) * experiment.samplers.size();
    for (const BenchScene& s : scenes) {
        const double per_path = seconds_per_path(s, registry, threads);
        const auto paths = static_cast<double>(paths_per_pixel(experiment) * experiment.samplers.size()) * static_cast<double>(s.what.crop.area());
        const auto file = find_reference(s.key);
        const double reference = file ? 0.0 : 2.0 * experiment.reference.replicates * static_cast<double>(experiment.reference.spp) * static_cast<double>(s.what.crop.area()) * per_path;
        total += paths * per_path + reference;
        fmt::print("{:<10}{:>12}{:>14.0f}{:>12.0f}{:>14.1f}  {}\n", s.what.name, runs, paths, per_path * 1e9, paths * per_path,
                   file ? file->string() : fmt::format("must be made: {:.1f} CPU seconds", reference));
    }
    fmt::print("about {} of CPU time, {} on {} cores, and the pictures and the report\n", duration_text(total), duration_text(total / cores), cores);
    return 0;
}

Json header_json(const Experiment& e, const std::vector<std::unique_ptr<SamplerFactory>>& samplers, const std::string& command_line, int threads) {
    const Machine m = machine();
    Json labels = Json::array();
    for (const auto& s : samplers) {
        std::string label = s->info().title;
        if (s->options().has("randomize")) label += " (" + s->options()["randomize"] + ")";
        labels.push_back({{"sampler", s->name()}, {"label", label}, {"version", s->info().version}});
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
            {"scenes", Json::array()}};
}

/// One measured render.
Row measure(const BenchScene& s, const SamplerFactory& sampler, const Reference& reference, std::uint64_t spp, int replicate, std::uint64_t base_seed, int threads,
            std::vector<float>& image) {
    const std::uint64_t seed = test_seed(base_seed, s.key.scene_hash, sampler.name(), spp, static_cast<std::uint64_t>(replicate));
    const auto source = sampler.bind(sampling_plan(s.scene, s.plan, spp, seed));
    RenderOptions options;
    options.threads = threads;
    const RenderResult result = render(s.scene, s.plan, *source, {s.what.crop, 0, spp}, options);
    image = result.film.image();
    const ReferenceError error = compare_to_reference(image, reference.mean, reference.variance);
    static const Machine kMachine = machine();
    const Vec3d mean = result.film.mean();
    Row row;
    row.scene = s.what.name;
    row.scene_hash = fmt::format("{:016x}", s.key.scene_hash);
    row.sampler = sampler.name();
    row.sampler_version = sampler.info().version;
    row.randomized = sampler.randomized();
    row.spp = spp;
    row.seed = seed;
    row.replicate = replicate;
    row.film[0] = s.scene.film.width;
    row.film[1] = s.scene.film.height;
    const int crop[4] = {s.what.crop.x, s.what.crop.y, s.what.crop.width, s.what.crop.height};
    std::copy(crop, crop + 4, row.crop);
    row.max_depth = s.plan.integrator.max_depth;
    row.rr_depth = s.plan.integrator.rr_depth;
    row.effects = s.plan.effects.names();
    row.dimensions = s.plan.layout.dimensions();
    row.kernel = result.stats.kernel;
    row.mse = error.mse;
    row.mse_raw = error.mse_raw;
    row.rmse = error.mse > 0.0 ? std::sqrt(error.mse) : 0.0;
    row.relmse = error.relmse;
    row.relmse_raw = error.relmse_raw;
    row.mean_rgb[0] = mean.x;
    row.mean_rgb[1] = mean.y;
    row.mean_rgb[2] = mean.z;
    row.wall_seconds = result.stats.wall_seconds;
    row.cpu_seconds = result.stats.cpu_seconds;
    row.sampler_seconds = result.stats.sampler_seconds;
    row.paths = result.stats.paths;
    row.rays = result.stats.rays.closest + result.stats.rays.shadow;
    row.invalid_samples = result.stats.invalid_samples;
    row.threads = threads > 0 ? threads : kMachine.cores;
    row.estimator_version = kEstimatorVersion;
    row.reference = s.key.digest();
    row.commit = commit();
    row.machine = kMachine.cpu;
    row.isa = kMachine.isa;
    return row;
}

/// The file name of a sampler's crop: options without the characters that file systems dislike.
std::string file_stem(std::string sampler) {
    for (char& c : sampler)
        if (c == ':' || c == '=' || c == ',' || c == '/') c = '-';
    return sampler;
}

/// The whole picture of a scene, small. @return its path relative to the results
std::string render_picture(const Experiment& e, const BenchScene& s, const Registry& registry, const std::filesystem::path& out, int threads) {
    SceneDescription description = load_scene(s.what.file);
    FilmSettings& film = description.film;
    const double scale = static_cast<double>(e.picture_size) / std::max(film.width, film.height);
    film = {std::max(1, static_cast<int>(film.width * scale)), std::max(1, static_cast<int>(film.height * scale)), 0, 0, 0, 0};
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

Json scene_json(const BenchScene& s, const Reference& reference) {
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
              {"file", file ? file->filename().string() : ""}}},
            {"picture", nullptr},
            {"reference_crop", nullptr},
            {"crops", Json::object()}};
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
    if (command.dry_run) return price(experiment, scenes, registry, command.threads);

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
        const auto per_scene = static_cast<double>(paths_per_pixel(experiment) * samplers.size());
        double done = 0.0;
        for (std::size_t i = 0; i < scenes.size(); ++i) {
            const BenchScene& s = scenes[i];
            const Reference& reference = references[i];
            Json entry = scene_json(s, reference);
            entry["picture"] = render_picture(experiment, s, registry, out, command.threads);
            const float exposure = exposure_for(reference.mean);
            entry["reference_crop"] = "pictures/" + s.what.name + "-reference.png";
            write_png(out / entry["reference_crop"].get<std::string>(), reference.mean, s.what.crop.width, s.what.crop.height, exposure);
            // Samplers take turns within a replicate: what slows the machine down slows all of them.
            const int most = *std::max_element(experiment.replicates.begin(), experiment.replicates.end());
            for (int replicate = 0; replicate < most; ++replicate)
                for (std::size_t k = 0; k < experiment.spp.size(); ++k) {
                    if (replicate >= experiment.replicates[k]) continue;
                    for (const auto& sampler : samplers) {
                        std::vector<float> image;
                        rows.push_back(measure(s, *sampler, reference, experiment.spp[k], replicate, experiment.seed, command.threads, image));
                        partial.add(rows.back());
                        if (replicate == 0 && experiment.spp[k] == experiment.crop_spp) {
                            const std::string name = "pictures/" + s.what.name + "-" + file_stem(sampler->name()) + ".png";
                            write_png(out / name, image, s.what.crop.width, s.what.crop.height, exposure);
                            entry["crops"][sampler->name()] = name;
                        }
                        done += static_cast<double>(experiment.spp[k]);
                        progress.update(done / (per_scene * static_cast<double>(scenes.size())), s.what.name);
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
