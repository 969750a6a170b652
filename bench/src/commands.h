#pragma once
// The commands of the program, as plain values and one function each. program.cpp fills them from the command line.

#include <koksma/sampling/registry.h>
#include <koksma/scene/load.h>

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace koksma {

/// Wrong usage: exit code 2 instead of 1.
class UsageError : public Error {
public:
    using Error::Error;
};

/// What render, replay and plan have in common.
struct SceneArguments {
    std::filesystem::path scene;
    std::vector<std::string> defines;            ///< name=value
    std::optional<std::string> sampler;
    std::optional<std::uint64_t> spp;
    std::optional<std::uint64_t> seed;
    std::optional<int> max_depth, rr_depth;
    std::string effects = "needed";              ///< as effects_of() takes them
    std::vector<int> crop;                       ///< x, y, width, height; empty: the scene's
    std::string technique;                       ///< mis, light or bsdf; empty: the scene's
};

struct RenderCommand {
    SceneArguments scene;
    std::filesystem::path output, stats;
    int threads = 0;
    std::string kernel;
    bool quiet = false, strict = false;
};
struct ReplayCommand {
    SceneArguments scene;
    std::vector<int> pixel;
    std::uint64_t sample = 0;
    std::filesystem::path from;                  ///< an image that koksma rendered: its settings
};
struct PlanCommand {
    SceneArguments scene;
    bool json = false;
};
struct CompareCommand {
    std::filesystem::path a, b;
    bool json = false;
};
struct BenchCommand {
    std::string experiment = "default";
    std::filesystem::path out;
    bool quick = false, dry_run = false, no_report = false;
    bool fresh = false;                          ///< do not keep rows of earlier runs
    std::string shard;                           ///< "k/n"; empty: all
    int threads = 0;
    std::vector<std::string> samplers;           ///< instead of the experiment's
    std::vector<std::string> scenes;             ///< only these
};
struct BudgetCommand {
    std::filesystem::path scene;                 ///< a file, or a name from the default experiment
    std::string sampler = "sobol:randomize=owen";
    std::uint64_t spp = 64, seed = 0;
    int replicates = 16, threads = 0;
    std::size_t bounces = 4;                     ///< later ones are one group
    std::filesystem::path out;
    bool no_report = false;
};
struct EstimateCommand {
    SceneArguments scene;
    std::filesystem::path output, stats;
    std::string light = "mis", directions = "bsdf", end = "throughput", number = "own";
    std::uint32_t branching = 1;
    int threads = 0;
    bool quiet = false;
};
struct AdaptiveCommand {
    SceneArguments scene;                        ///< spp is the average
    std::filesystem::path output;
    std::string mode = "two-stage";
    std::uint64_t most = 1024;
    int threads = 0;
    bool quiet = false;
};
struct LectureCommand {
    std::vector<std::string> topics;             ///< empty: all
    std::filesystem::path out = "koksma-bench/lecture";
    std::uint64_t seed = 0;
    int threads = 0;
    bool quick = false, no_report = false;
};
struct MergeCommand {
    std::vector<std::filesystem::path> parts;
    std::filesystem::path out;
    bool no_report = false;
};
struct ReportCommand {
    std::filesystem::path directory;             ///< that bench wrote
    std::filesystem::path figures;               ///< JSON: what a paper's figures show
    bool anonymous = false;                      ///< a copy without machine, paths and commit
};
struct ReferenceCommand {
    std::string experiment = "default";
    std::filesystem::path out;
    std::vector<std::string> scenes;
    std::uint64_t spp = 0;                       ///< per replicate; 0: the experiment's
    int threads = 0;
    bool force = false;
    bool check = false;                          ///< also against a third render
};

struct CheckCommand {
    std::string sampler = "all";                 ///< a name, a name with options, or all
    std::uint64_t seed = 0;                      ///< 0: the seeds of the tests; others are fresh trials
    bool json = false;
};
struct PointsCommand {
    std::string sampler;
    std::uint64_t n = 64, seed = 0;
    std::uint32_t dims = 2;
    std::vector<int> pixel;                      ///< x, y; empty: 0, 0
    std::filesystem::path csv, npy;              ///< neither: a table on standard output
};
struct RatesCommand {
    std::vector<std::string> samplers;           ///< empty: all, at their default options
    std::vector<std::string> integrands;         ///< names; empty: all
    std::string set;                             ///< a named choice of both, where they are not given
    std::uint64_t most = 4096;                   ///< samples
    int replicates = 256;
    bool json = false;
};
struct CardCommand {
    std::string sampler;
    std::filesystem::path output;
    bool json = false;                           ///< the numbers, not the page
};

struct LimitsCommand {
    SceneArguments settings;                     ///< its scene is set for each of `scenes`
    std::vector<std::filesystem::path> scenes;
    std::string kernel;
    int rounds = 7, threads = 2;
    bool not_robust = false, scaling = false, growth = false;
    std::uint64_t memory_gb = 4;
    std::filesystem::path json;
};

int run_render(const RenderCommand& command, const Registry& registry);
int run_replay(const ReplayCommand& command, const Registry& registry);
int run_plan(const PlanCommand& command, const Registry& registry);
int run_compare(const CompareCommand& command);
int run_samplers(bool json, const Registry& registry);
int run_bench(const BenchCommand& command, const Registry& registry, const std::string& command_line);
int run_budget(const BudgetCommand& command, const Registry& registry, const std::string& command_line);
int run_estimate(const EstimateCommand& command, const Registry& registry);
int run_adaptive(const AdaptiveCommand& command, const Registry& registry);
int run_lecture(const LectureCommand& command, const Registry& registry, const std::string& command_line);
/// The robustness ladder: `bench ladder`.
int run_ladder(const BenchCommand& command, const Registry& registry, const std::string& command_line);
int run_merge(const MergeCommand& command);
int run_reference(const ReferenceCommand& command, const Registry& registry);
int run_check(const CheckCommand& command, const Registry& registry);
int run_points(const PointsCommand& command, const Registry& registry);
int run_rates(const RatesCommand& command, const Registry& registry);
int run_card(const CardCommand& command, const Registry& registry);
int run_limits(const LimitsCommand& command, const Registry& registry);
int run_report(const ReportCommand& command);

}  // namespace koksma
