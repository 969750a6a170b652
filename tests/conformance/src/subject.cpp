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
    p.independent_samples = name == "random";
    p.nested_scrambling = (name == "halton" || name == "sobol") && randomize.starts_with("owen");
    p.strata_prime_bases = name == "halton";
    if (name == "sobol") {
        p.strata_base = 2;
        p.net_of_first_pair = true;
        p.sobol_projections = true;
    }
}

std::vector<std::string> combinations(const SamplerInfo& info) {
    std::vector<std::string> specs{info.name};
    for (const OptionInfo& option : info.options) {
        if (option.values.empty()) continue;
        std::vector<std::string> longer;
        for (const std::string& spec : specs)
            for (const std::string& value : option.values)
                longer.push_back(spec + (spec.find(':') == std::string::npos ? ':' : ',') + option.name + "=" + value);
        specs = std::move(longer);
    }
    return specs;
}

}  // namespace

std::vector<Subject> subjects(const Registry& registry, const SamplerInfo& info) {
    std::vector<Subject> all;
    for (const std::string& spec : combinations(info)) {
        Subject s;
        s.factory = registry.make(spec);
        s.promises = described_promises(info);
        const SamplerOptions& options = s.factory->options();
        named_promises(info.name, options.has("randomize") ? options["randomize"] : std::string{}, s.promises);
        s.randomized = s.factory->randomized();
        s.pixels_shared = options.has("pixels") && options["pixels"] == "shared";
        s.pixels_independent = info.scope == SamplerScope::pixel && (!options.has("pixels") || options["pixels"] == "independent");
        all.push_back(std::move(s));
    }
    return all;
}

std::vector<Subject> subjects(const Registry& registry) {
    std::vector<Subject> all;
    for (const SamplerInfo& info : registry.infos())
        for (Subject& s : subjects(registry, info)) all.push_back(std::move(s));
    return all;
}

}  // namespace koksma::conformance
