#include "reference_points.h"

#include <koksma/conformance/subject.h>

namespace koksma::conformance {

namespace {

/// What follows from the sampler's description alone.
Promises described_promises(const SamplerInfo& info) {
    Promises p;
    if (info.scope != SamplerScope::pixel) return p;
    if (info.kind == SamplerKind::sequence && info.good_counts.rule == GoodCounts::Rule::power) p.strata_base = info.good_counts.base;
    if (info.kind == SamplerKind::set) {
        p.strata_of_set = true;
        p.cells_of_set = info.good_counts.rule == GoodCounts::Rule::square;
    }
    return p;
}

/// Special promises that a description has no field for.
void named_promises(const std::string& name, const std::string& randomize, Promises& p) {
    p.multiples_of_2_24 = name == "random" || name == "stratified" || name == "halton" || name == "sobol";
    if (randomize == "none" && name == "sobol") p.reference_points = kSobolPoints;
    if (randomize == "none" && name == "halton") p.reference_points = kHaltonPoints;
    p.strata_of_pairs = name == "lhs" || name == "multijitter";
    p.net_of_pairs = name == "sobol-padded" || name == "pmj02";
    p.independent_samples = name == "random";
    p.nested_scrambling = (name == "halton" || name == "sobol") && randomize.starts_with("owen");
    p.strata_prime_bases = name == "halton";
    p.strata_rotated = randomize == "cp";
    if (name == "sobol") {
        p.strata_base = 2;
        p.net_of_first_pair = true;
        p.sobol_projections = true;
    }
    if (name == "zsobol") p.strata_of_set = p.net_of_pairs = p.multiples_of_2_24 = true;
    if (name == "bluenoise") {
        p.strata_base = 2;
        p.net_of_pairs = p.nested_scrambling = p.multiples_of_2_24 = true;
    }
    if (name == "sobol-global" || name == "halton-global" || name == "matrices" || name == "points") p.multiples_of_2_24 = true;
    p.values_in_finest_strata = name == "matrices";
    if (name == "points") p.strata_of_set = false;  // whatever the file has
}

/// The same of samplers in tables, in sets and padded, where they depend on their options.
void padded_promises(const std::string& name, const SamplerOptions& options, Promises& p) {
    const auto is = [&](const char* option, std::string_view value) { return options.has(option) && options[option] == value; };
    for (const char* exact : {"multijitter", "lhs", "pmj02", "sobol-padded", "sobol-4d", "lattice", "kronecker", "faure"})
        p.multiples_of_2_24 = p.multiples_of_2_24 || name == exact;
    for (const char* owen : {"pmj02", "sobol-padded", "sobol-4d", "faure"})
        p.nested_scrambling = p.nested_scrambling || (name == owen && is("randomize", "owen"));
    p.cells_of_set = p.cells_of_set || name == "multijitter";
    p.net_of_pairs = p.net_of_pairs || name == "sobol-4d";  // in a plain layout every pair is a set
    if (name == "pmj02") p.prefixes_only = true;
    if (name == "faure") p.joint_across_slots = true;
    // Shifts and tents move points across the edges of strata; multiples of an irrational have none.
    if (name == "kronecker" || (name == "pmj02" && is("randomize", "cp")) || (name == "lattice" && is("tent", "on"))) {
        p.strata_base = 0;
        p.net_of_pairs = false;
    }
}

/// All values of the options that list theirs and that are not given.
std::vector<std::string> combinations(const SamplerInfo& info, std::string_view spec) {
    std::vector<std::string> specs{std::string(spec)};
    for (const OptionInfo& option : info.options) {
        const bool given = spec.find(":" + option.name + "=") != std::string_view::npos || spec.find("," + option.name + "=") != std::string_view::npos;
        if (option.values.empty() || given) continue;
        std::vector<std::string> longer;
        for (const std::string& s : specs)
            for (const std::string& value : option.values)
                longer.push_back(s + (s.find(':') == std::string::npos ? ':' : ',') + option.name + "=" + value);
        specs = std::move(longer);
    }
    return specs;
}

}  // namespace

std::span<const ReferencePoint> sobol_reference_points() noexcept { return kSobolPoints; }
std::span<const ReferencePoint> halton_reference_points() noexcept { return kHaltonPoints; }

bool needs_a_file(const Registry& registry, const SamplerInfo& info) {
    try {
        (void)registry.make(info.name);
        return false;
    } catch (const Error&) {
        return true;
    }
}

std::vector<Subject> subjects(const Registry& registry, std::string_view spec) {
    const SamplerInfo info = registry.make(spec)->info();
    std::vector<Subject> all;
    for (const std::string& one : combinations(info, spec)) {
        Subject s;
        s.factory = registry.make(one);
        s.promises = described_promises(info);
        const SamplerOptions& options = s.factory->options();
        named_promises(info.name, options.has("randomize") ? options["randomize"] : std::string{}, s.promises);
        padded_promises(info.name, options, s.promises);
        s.randomized = s.factory->randomized();
        s.pixels_shared = options.has("pixels") && options["pixels"] == "shared";
        s.pixels_independent = info.scope == SamplerScope::pixel && (!options.has("pixels") || options["pixels"] == "independent");
        all.push_back(std::move(s));
    }
    return all;
}

std::vector<Subject> subjects(const Registry& registry) {
    std::vector<Subject> all;
    for (const SamplerInfo& info : registry.infos()) {
        if (needs_a_file(registry, info)) continue;
        for (Subject& s : subjects(registry, info.name)) all.push_back(std::move(s));
    }
    return all;
}

}  // namespace koksma::conformance
