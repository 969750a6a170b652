#include <koksma/bench/program.h>

#include "commands.h"
#include "machine.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <charconv>
#include <cstdio>
#include <functional>

namespace koksma {

namespace {

/// CLI11 lets "-3" wrap around and "1e30" saturate. @return  empty, or what is wrong
std::string not_a_count(const std::string& text) {
    std::uint64_t value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    return error == std::errc{} && end == text.data() + text.size() ? "" : fmt::format("'{}' is not an integer in [0, 2^64)", text);
}

/// One line for whatever the parser refused.
std::string usage_message(const CLI::App& app, const CLI::ParseError& e) {
    const auto commands = app.get_subcommands();
    if (!commands.empty()) return fmt::format("{}; see koksma {} --help", e.what(), commands.front()->get_name());
    std::string known;
    for (const CLI::App* c : app.get_subcommands([](const CLI::App*) { return true; })) known += (known.empty() ? "" : ", ") + c->get_name();
    const std::vector<std::string> unknown = app.remaining();
    return fmt::format("{}; commands: {}", unknown.empty() ? "a command is required" : "unknown command '" + unknown.front() + "'", known);
}

void add_render_settings(CLI::App* app, SceneArguments& a) {
    app->add_option("-s,--sampler", a.sampler, "Sampler with options, as in sobol:randomize=owen (koksma samplers lists them)");
    app->add_option("-n,--spp", a.spp, "Samples per pixel")->check(not_a_count);
    app->add_option("--seed", a.seed, "Seed, below 2^63; every seed is an independent replicate (default 0)")->check(not_a_count);
    app->add_option("--max-depth", a.max_depth, "Longest path in vertices: 1 sees emission only, -1 has no limit");
    app->add_option("--rr-depth", a.rr_depth, "Russian roulette from this depth on");
    app->add_option("--technique", a.technique,
                    "Direct light by light sampling or BSDF sampling alone: light, bsdf; mis: both (default: the scene's)")
        ->check(CLI::IsMember({"mis", "light", "bsdf"}));
    app->add_option("--effects", a.effects, "Effects to plan for, at least the needed ones: names with commas; 'needed' and 'all' stand for sets (default: needed)");
    app->add_option("--crop", a.crop, "Render only this part of the film: X,Y,WIDTH,HEIGHT")->delimiter(',')->expected(4);
    app->add_option("-D", a.defines, "Value of a scene parameter: name=value")->take_all()->allow_extra_args(false);
}

void add_scene_options(CLI::App* app, SceneArguments& a, bool scene_required = true) {
    CLI::Option* scene = app->add_option("scene", a.scene, "Scene file (Mitsuba 3 XML)");
    if (scene_required) scene->required();
    add_render_settings(app, a);
}

std::string joined(int argc, char** argv) {
    std::string out = "./koksma";
    for (int i = 1; i < argc; ++i) out += std::string(" ") + argv[i];
    return out;
}

}  // namespace

int run_program(int argc, char** argv) {
    CLI::App app("Koksma: what a sample sequence buys, in error and in time, when it drives a real path tracer.\n"
                 "Exit codes: 0 success, 1 failure, 2 wrong usage.",
                 "koksma");
    app.set_version_flag("--version", version_text());
    app.require_subcommand(1);
    std::function<int()> action;
    Registry registry;

    RenderCommand render;
    CLI::App* c = app.add_subcommand("render", "Render a scene to an OpenEXR file");
    add_scene_options(c, render.scene);
    c->add_option("-o,--output", render.output, "Image to write (.exr)")->required();
    c->add_option("-t,--threads", render.threads, "Threads; 0: all (the image does not depend on it)")->check(CLI::Range(0, 4096));
    c->add_option("--stats", render.stats, "Also write statistics as JSON");
    c->add_option("--kernel", render.kernel, "A kernel with at least the scene's effects (koksma plan lists them)");
    c->add_flag("--strict", render.strict, "Fail if any sample is invalid");
    c->add_flag("-q,--quiet", render.quiet, "No progress");
    c->final_callback([&] { action = [&] { return run_render(render, registry); }; });

    BenchCommand bench;
    c = app.add_subcommand("bench", "Run an experiment: error against samples and against seconds, with a report");
    c->add_option("experiment", bench.experiment,
                  "Name of an experiment or a JSON file (default: default); ladder: scenes with known answers, each to where float ends");
    c->add_option("-o,--out", bench.out, "Folder for results.jsonl, summary.json and report.html (default: koksma-bench/NAME)");
    c->add_flag("--quick", bench.quick, "Fewer samples and replicates: under a minute");
    c->add_flag("--dry-run", bench.dry_run, "Only say what would be rendered and what it would cost");
    c->add_flag("--no-report", bench.no_report, "Do not make report.html");
    c->add_option("-s,--sampler", bench.samplers, "Samplers instead of the experiment's; may be repeated")->take_all();
    c->add_option("--scene", bench.scenes, "Only these scenes of the experiment; may be repeated")->take_all();
    c->add_option("-t,--threads", bench.threads, "Threads; 0: all")->check(CLI::Range(0, 4096));
    c->add_flag("--fresh", bench.fresh, "Render all again, also what an earlier run in the folder has rendered");
    c->add_option("--shard", bench.shard, "Only part k of n, as in 2/3, into FOLDER/shard-k-of-n; koksma merge puts them together");
    const std::string command_line = joined(argc, argv);
    CLI::App* const bench_app = c;
    c->final_callback([&, bench_app] {
        if (bench_app->get_subcommands().empty()) action = [&] {
                return bench.experiment == "ladder" ? run_ladder(bench, registry, command_line) : run_bench(bench, registry, command_line);
            };
    });
    c->footer("Experiments of their own: koksma bench budget --help, koksma bench lecture --help");

    BudgetCommand budget;
    c = bench_app->add_subcommand("budget", "Where a scene's error comes from: each group of random decisions with independent numbers alone, or with the sequence alone");
    c->add_option("scene", budget.scene, "A scene of the default experiment by name, or a file (.xml)")->required();
    c->add_option("-s,--sampler", budget.sampler, "The sequence (default sobol:randomize=owen)");
    c->add_option("-n,--spp", budget.spp, "Samples per pixel (default 64)")->check(CLI::Range(std::uint64_t{1}, std::uint64_t{1} << 24));
    c->add_option("-r,--replicates", budget.replicates, "Renders of each kind (default 16)")->check(CLI::Range(2, 10000));
    c->add_option("--bounces", budget.bounces, "Bounces that are told apart; later ones are one group (default 4)")->check(CLI::Range(0, 64));
    c->add_option("--seed", budget.seed, "Seed (default 0)")->check(not_a_count);
    c->add_option("-o,--out", budget.out, "Folder for budget.json and budget.html (default: koksma-bench/budget-SCENE)");
    c->add_option("-t,--threads", budget.threads, "Threads; 0: all")->check(CLI::Range(0, 4096));
    c->add_flag("--no-report", budget.no_report, "Do not make budget.html");
    c->final_callback([&] { action = [&] { return run_budget(budget, registry, command_line); }; });

    LectureCommand lecture;
    c = bench_app->add_subcommand("lecture", "The course on path tracing as experiments: every claim measured, beside its closed form where there is one");
    c->add_option("topics", lecture.topics, "Only these topics (docs/lecture.md lists them)");
    c->add_option("-o,--out", lecture.out, "Folder for lecture.json and lecture.html (default: koksma-bench/lecture)");
    c->add_option("--seed", lecture.seed, "Seed (default 0)")->check(not_a_count);
    c->add_option("-t,--threads", lecture.threads, "Threads; 0: all")->check(CLI::Range(0, 4096));
    c->add_flag("--quick", lecture.quick, "A quarter of the replicates");
    c->add_flag("--no-report", lecture.no_report, "Do not make lecture.html");
    c->final_callback([&] { action = [&] { return run_lecture(lecture, registry, command_line); }; });

    EstimateCommand estimate;
    c = app.add_subcommand("estimate",
                           "Render with the lecture's recursive estimator: how light is found, how directions are drawn, how paths end and branch.\n"
                           "The image has layers Le, Ldirect, Lindirect, and scattered0, scattered1 ... for light that was scattered so often; prints a ledger of\n"
                           "what truncation, roulette and invalid samples cost");
    add_scene_options(c, estimate.scene);
    c->add_option("-o,--output", estimate.output, "Image to write (.exr)")->required();
    c->add_option("--light", estimate.light, "How light is found: bsdf (by meeting it), light (by sampling it), mis (both; default)");
    c->add_option("--directions", estimate.directions, "How directions are drawn: bsdf (default), uniform (on the hemisphere)");
    c->add_option("--end", estimate.end,
                  "How paths end: none, depth=N, threshold=T (biased), or by roulette: constant=Q, reflectance, throughput (default). From --rr-depth on");
    c->add_option("--roulette-number", estimate.number, "own (default), or rescaled: the direction's number decides and is stretched anew (diffuse surfaces)");
    c->add_option("--branching", estimate.branching, "Light samples and directions at every vertex (default 1)")->check(CLI::Range(1, 1024));
    c->add_option("--stats", estimate.stats, "Also write the ledger as JSON");
    c->add_option("-t,--threads", estimate.threads, "Threads; 0: all (the image does not depend on it)")->check(CLI::Range(0, 4096));
    c->add_flag("-q,--quiet", estimate.quiet, "Do not print the ledger");
    c->final_callback([&] { action = [&] { return run_estimate(estimate, registry); }; });

    AdaptiveCommand adaptive;
    c = app.add_subcommand("adaptive", "Render with more samples where a pilot found more noise, --spp on average; the image has a channel `samples`");
    add_scene_options(c, adaptive.scene);
    c->add_option("-o,--output", adaptive.output, "Image to write (.exr)")->required();
    c->add_option("--mode", adaptive.mode, "two-stage (default): the pilot is discarded, no bias; one-stage: it is kept, with a bias");
    c->add_option("--most", adaptive.most, "Most samples of a pixel (default 1024)")->check(CLI::Range(std::uint64_t{4}, std::uint64_t{1} << 20));
    c->add_option("-t,--threads", adaptive.threads, "Threads; 0: all (the image does not depend on it)")->check(CLI::Range(0, 4096));
    c->add_flag("-q,--quiet", adaptive.quiet, "Print nothing");
    c->final_callback([&] { action = [&] { return run_adaptive(adaptive, registry); }; });

    MergeCommand merge;
    c = app.add_subcommand("merge", "Put the parts of a bench --shard run together");
    c->add_option("parts", merge.parts, "Folders of all parts")->required();
    c->add_option("-o,--out", merge.out, "Folder to write to")->required();
    c->add_flag("--no-report", merge.no_report, "Do not make report.html");
    c->final_callback([&] { action = [&] { return run_merge(merge); }; });

    CompareCommand compare;
    c = app.add_subcommand("compare", "Compare two images: RMSE, relMSE and more (B is the reference)");
    c->add_option("a", compare.a, "Image (.exr)")->required();
    c->add_option("b", compare.b, "Reference image (.exr)")->required();
    c->add_flag("--json", compare.json, "Print JSON");
    c->final_callback([&] { action = [&] { return run_compare(compare); }; });

    PlanCommand plan;
    c = app.add_subcommand("plan", "Show what a scene calls for: effects, slots, kernel, where the tail starts");
    add_scene_options(c, plan.scene);
    c->add_flag("--json", plan.json, "Print JSON");
    c->final_callback([&] { action = [&] { return run_plan(plan, registry); }; });

    bool samplers_json = false;
    c = app.add_subcommand("samplers", "List the samplers with their options and limits");
    c->add_flag("--json", samplers_json, "Print JSON");
    c->final_callback([&] { action = [&] { return run_samplers(samplers_json, registry); }; });

    CheckCommand check;
    c = app.add_subcommand("check", "Check a sampler: range, purity, strata, nets, keys, independence, bias (exit code 1 if one fails)");
    c->add_option("sampler", check.sampler, "Sampler, with options or without (then in all combinations), or all (default)");
    c->add_option("--seed", check.seed, "A fresh trial; 0: the seeds of the tests (default)")->check(not_a_count);
    c->add_flag("--json", check.json, "Print JSON");
    c->final_callback([&] { action = [&] { return run_check(check, registry); }; });

    PointsCommand points;
    c = app.add_subcommand("points", "Write the points of a sampler");
    c->add_option("sampler", points.sampler, "Sampler with options, as in sobol:randomize=none")->required();
    c->add_option("-n,--n", points.n, "Number of points, also the samples per pixel of the plan (default 64)")->check(not_a_count);
    c->add_option("-d,--dims", points.dims, "Number of dimensions, drawn in pairs (default 2)")->check(CLI::Range(1u, 1u << 20));
    c->add_option("--seed", points.seed, "Seed (default 0)")->check(not_a_count);
    c->add_option("--pixel", points.pixel, "X,Y (default 0,0)")->delimiter(',')->expected(2);
    CLI::Option* csv = c->add_option("--csv", points.csv, "Write a text file, a point a line, numbers separated by commas");
    c->add_option("--npy", points.npy, "Write a NumPy file of float32, shape (points, dimensions)")->excludes(csv);
    c->final_callback([&] { action = [&] { return run_points(points, registry); }; });

    RatesCommand rates;
    c = app.add_subcommand("rates", "Measure how the error of samplers falls on integrands with known integrals");
    c->add_option("-s,--samplers", rates.samplers, "Samplers (default: all, at their default options)");
    c->add_option("-i,--integrands", rates.integrands, "Integrands by name (default: all)");
    c->add_option("--set", rates.set, "A named choice of both: joint-padded (Sobol' whole, in fours and in pairs, on sums and products of dimensions)");
    c->add_option("-n,--most", rates.most, "Largest number of samples (default 4096)")->check(not_a_count);
    c->add_option("-r,--replicates", rates.replicates, "Independent replicates (default 256)")->check(CLI::Range(2, 1 << 20));
    c->add_flag("--json", rates.json, "Print JSON, with the error at every count");
    c->final_callback([&] { action = [&] { return run_rates(rates, registry); }; });

    CardCommand card;
    c = app.add_subcommand("card", "One page about a sampler: pictures, spectrum, discrepancies, quality, rates");
    c->add_option("sampler", card.sampler, "Sampler with options")->required();
    c->add_option("-o,--output", card.output, "HTML file to write (default: NAME.html)");
    c->add_flag("--json", card.json, "Print the numbers as JSON instead");
    c->final_callback([&] { action = [&] { return run_card(card, registry); }; });

    ReferenceCommand reference;
    c = app.add_subcommand("reference", "Make the references of an experiment (they are cached; bench makes missing ones itself)");
    c->add_option("experiment", reference.experiment, "Name of an experiment or a JSON file (default: default)");
    c->add_option("-o,--out", reference.out, "Folder to write to (default: the user's cache)");
    c->add_option("--scene", reference.scenes, "Only these scenes; may be repeated")->take_all();
    c->add_option("-n,--spp", reference.spp, "Samples per pixel of each replicate")->check(not_a_count);
    c->add_option("-t,--threads", reference.threads, "Threads; 0: all")->check(CLI::Range(0, 4096));
    c->add_flag("--force", reference.force, "Remake those that exist");
    c->add_flag("--check", reference.check, "Also compare with a third render by another estimator, and print the smallest bias that it could have seen");
    c->final_callback([&] { action = [&] { return run_reference(reference, registry); }; });

    LimitsCommand limits;
    c = app.add_subcommand("limits",
                           "Measure the distance to the physical limit: rendering against Embree alone on the same rays (exit code 1 if the kernel's rays\n"
                           "are not those of the reference kernel). T/E1: CPU time of a render over that of its rays asked one by one; T/Eown: over that of\n"
                           "the kernel's own packets. Medians of per-round ratios, all in one run on one thread.");
    c->add_option("scenes", limits.scenes, "Scene files (Mitsuba 3 XML)")->required();
    add_render_settings(c, limits.settings);
    c->get_option("--spp")->description("Samples per pixel (default 16)");
    c->add_option("-r,--rounds", limits.rounds, "Interleaved rounds (default 7)")->check(CLI::Range(1, 1000));
    c->add_option("--kernel", limits.kernel, "A kernel with at least the scenes' effects (default: the one that renders use)");
    c->add_option("--memory", limits.memory_gb, "GB that recorded rays may take, twice (default 4)")->check(CLI::Range(1, 1024));
    c->add_flag("--not-robust", limits.not_robust, "Diagnostic: build the BVH without Embree's robust flag, as renderers do that let rays slip through edges");
    CLI::Option* scaling = c->add_flag("--scaling", limits.scaling, "Instead: how rendering scales with threads, beside pure arithmetic");
    c->add_option("-t,--threads", limits.threads, "Threads of --scaling (default 2)")->check(CLI::Range(2, 4096));
    c->add_flag("--growth", limits.growth, "Instead: time and memory against samples per pixel and against pixels")->excludes(scaling);
    c->add_option("--json", limits.json, "Also write the figures as JSON");
    c->final_callback([&] { action = [&] { return run_limits(limits, registry); }; });

    ReportCommand report;
    c = app.add_subcommand("report", "Make summary.json and report.html again from a folder's results.jsonl; and figures, tables and crops for a paper");
    c->add_option("dir", report.directory, "Folder that koksma bench wrote")->required();
    c->add_option("--figures", report.figures, "JSON file that chooses samplers, labels, colours and column width of the figures in DIR/figures");
    c->add_flag("--anonymous", report.anonymous, "Write all to DIR/anonymous, without machine, paths and commit");
    c->final_callback([&] { action = [&] { return run_report(report); }; });

    ReplayCommand replay;
    c = app.add_subcommand("replay", "Print one camera sample's path vertex by vertex");
    add_scene_options(c, replay.scene, false);
    c->add_option("--pixel", replay.pixel, "X,Y on the full film")->delimiter(',')->expected(2)->required();
    c->add_option("--sample", replay.sample, "Index of the sample in its pixel")->required()->check(not_a_count);
    c->add_option("--from", replay.from, "Take scene, sampler, spp, seed and settings from an image that koksma rendered");
    c->final_callback([&] { action = [&] { return run_replay(replay, registry); }; });

    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError& e) {
        if (e.get_exit_code() == 0) return app.exit(e);  // --help, --version
        fmt::print(stderr, "koksma: {}\n", usage_message(app, e));
        return 2;
    }
    try {
        register_samplers(registry);
        const int code = action();
        if (std::fflush(stdout) != 0) throw Error("cannot write to standard output; what was printed is incomplete");
        return code;
    } catch (const UsageError& e) {
        fmt::print(stderr, "koksma: {}\n", e.what());
        return 2;
    } catch (const std::bad_alloc&) {
        fmt::print(stderr, "koksma: out of memory; render a part of the film with --crop, or a smaller film\n");
        return 1;
    } catch (const std::exception& e) {
        const bool full = std::ferror(stdout) != 0;  // fmt throws when a buffer does not fit on the disk
        fmt::print(stderr, "koksma: {}\n", full ? "cannot write to standard output; what was printed is incomplete" : e.what());
        return 1;
    }
}

}  // namespace koksma
