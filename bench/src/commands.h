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
    std::vector<int> crop;                       ///< x, y, width, height; empty: the scene's
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
    int threads = 0;
    std::vector<std::string> samplers;           ///< instead of the experiment's
    std::vector<std::string> scenes;             ///< only these
};
struct ReferenceCommand {
    std::string experiment = "default";
    std::filesystem::path out;
    std::vector<std::string> scenes;
    std::uint64_t spp = 0;                       ///< per replicate; 0: the experiment's
    int threads = 0;
    bool force = false;
};

int run_render(const RenderCommand& command, const Registry& registry);
int run_replay(const ReplayCommand& command, const Registry& registry);
int run_plan(const PlanCommand& command, const Registry& registry);
int run_compare(const CompareCommand& command);
int run_samplers(bool json, const Registry& registry);
int run_bench(const BenchCommand& command, const Registry& registry, const std::string& command_line);
int run_reference(const ReferenceCommand& command, const Registry& registry);
int run_report(const std::filesystem::path& directory);

}  // namespace koksma
