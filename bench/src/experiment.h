#pragma once
// What an experiment renders: a small JSON file, checked.

#include "prediction.h"

#include <koksma/film/film.h>
#include <koksma/sampling/sampler.h>

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace koksma {

struct ExperimentScene {
    std::filesystem::path file{};
    std::string name{};              ///< the file's stem, and the effects where they are not the needed ones
    std::string effects = "needed";  ///< as effects_of() takes them
    PixelRect crop{};                ///< where errors are measured
    std::vector<Prediction> predictions{};
};

/// Renders of each sampler on each scene: replicates[i] of them at spp[i].
struct Experiment {
    std::filesystem::path file{};
    std::string name, title;
    std::vector<ExperimentScene> scenes;
    std::vector<std::string> samplers;
    std::vector<std::uint64_t> spp;
    std::vector<int> replicates;
    bool own_counts = false;                     ///< each sampler also at the good counts of its own base, within the range of spp
    std::vector<std::string> effects{"needed"};  ///< each scene once with each of these sets, in turn; the first is what the others are compared with
    int progressive = 0;                         ///< renders to the largest spp whose prefixes at every spp make a curve of their own
    int layouts = 1;                             ///< the layout as it stands and layouts - 1 permuted ones
    std::uint64_t seed = 0;
    std::vector<double> targets{1e-2, 1e-3, 1e-4};   ///< of relMSE, for the time to reach them
    std::uint64_t crop_spp = 16;                     ///< whose images the report shows
    int picture_size = 256;
    std::uint64_t picture_spp = 64;
    struct {
        std::vector<std::string> samplers;           ///< two, one per half
        int replicates = 8;
        std::uint64_t spp = 2048;
    } reference;
};

/// @param name_or_file  "default" (a file of bench/experiments) or a path ending in .json
/// @throws Error naming the file, the key and what was expected; unknown keys are errors
[[nodiscard]] Experiment load_experiment(const std::string& name_or_file);

/// The good counts of a sampler's own base within the experiment's range: powers of the base, of 4 where squares are good, none
/// where any count is.
[[nodiscard]] std::vector<std::uint64_t> own_counts(const Experiment& experiment, const SamplerInfo& info);

/// One number of samples and how many renders of it.
struct Count {
    std::uint64_t spp = 0;
    int replicates = 0;
};

/// What a sampler is run at: the experiment's counts, and its own where it asks for them (as many replicates as the next smaller one).
[[nodiscard]] std::vector<Count> counts_of(const Experiment& experiment, const SamplerInfo& info);

/// The same with fewer samples and replicates, for a first look within a minute.
[[nodiscard]] Experiment quick(Experiment experiment);

/// Root of the data that ships with the program (scenes, experiments, references, the report's Python): the environment variable
/// KOKSMA_DATA_DIR, else ../share/koksma beside an installed program's folder, else the source tree.
[[nodiscard]] std::filesystem::path data_directory();

}  // namespace koksma
