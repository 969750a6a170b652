#include "commands.h"
#include "rates_json.h"
#include "scene_setup.h"

#include <koksma/rates/rates.h>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>

namespace koksma {

namespace {

using convergence::Integrand;
using convergence::Rates;

/// The integrands of these names; all for no name.
std::vector<Integrand> chosen(const std::vector<std::string>& names, std::span<const Integrand> from) {
    std::vector<Integrand> all;
    for (const Integrand& f : from)
        if (names.empty() || std::find(names.begin(), names.end(), label(f)) != names.end() || std::find(names.begin(), names.end(), f.name) != names.end())
            all.push_back(f);
    return all;
}

void refuse_unknown(const std::vector<std::string>& names) {
    for (const std::string& name : names) {
        if (!chosen({name}, convergence::kOneDimensional).empty() || !chosen({name}, convergence::kMultiDimensional).empty()) continue;
        std::string known;
        for (const Integrand& f : convergence::kOneDimensional) known += (known.empty() ? "" : ", ") + label(f);
        for (const Integrand& f : convergence::kMultiDimensional) known += ", " + label(f);
        throw UsageError("unknown integrand '" + name + "'; integrands: " + known);
    }
}

/// Choices worth a name.
struct NamedSet {
    const char* name;
    std::vector<std::string> samplers, integrands;
};
const NamedSet& named_set(const std::string& name) {
    static const std::vector<NamedSet> kSets{
        {"joint-padded", {"sobol", "sobol-4d", "sobol-padded", "pmj02", "lhs", "random"}, {"addexp2", "prodlin4", "addexp6", "prodlin6"}}};
    for (const NamedSet& set : kSets)
        if (set.name == name) return set;
    throw UsageError("unknown set '" + name + "'; sets: joint-padded");
}

std::string slope_text(const Rates& r) {
    if (!std::isfinite(r.slope)) return "exact";
    return std::isfinite(r.slope_error) ? fmt::format("{:.3f} +-{:.3f}", r.slope, 1.96 * r.slope_error) : fmt::format("{:.3f}", r.slope);
}

}  // namespace

std::string label(const Integrand& f) { return fmt::format("{}{}", f.name, f.name.back() == static_cast<char>('0' + f.dimensions) ? "" : std::to_string(f.dimensions)); }

std::vector<Rates> all_rates(const SamplerFactory& factory, const std::vector<std::string>& integrands, std::uint64_t most, int replicates) {
    const std::vector<std::uint64_t> counts = convergence::counts_for(factory.info(), most);
    if (counts.size() < 2)
        throw UsageError(fmt::format("a slope needs two good counts from 64 to {}; sampler '{}' has {} ({})", most, factory.name(), counts.size(),
                                     factory.info().good_counts.text()));
    std::vector<Rates> all;
    for (const std::span<const Integrand> part : {std::span<const Integrand>(convergence::kOneDimensional), std::span<const Integrand>(convergence::kMultiDimensional)}) {
        const std::vector<Integrand> wanted = chosen(integrands, part);
        if (wanted.empty()) continue;
        for (Rates& r : convergence::run_rates(factory, wanted, {.counts = counts, .replicates = replicates})) all.push_back(std::move(r));
    }
    return all;
}

nlohmann::ordered_json json_of(const Rates& r) {
    nlohmann::ordered_json errors = nlohmann::ordered_json::array();
    for (const convergence::ErrorAtCount& e : r.errors)
        errors.push_back({{"n", e.count}, {"rmse", e.rmse}, {"bias_z", e.bias_z}, {"kurtosis", e.kurtosis}});
    return {{"integrand", label(r.integrand)}, {"dimensions", r.integrand.dimensions}, {"slope", r.slope}, {"lo", r.slope - 1.96 * r.slope_error},
            {"hi", r.slope + 1.96 * r.slope_error}, {"errors", errors}};
}

int run_rates(const RatesCommand& given, const Registry& registry) {
    RatesCommand command = given;
    if (!command.set.empty()) {
        const NamedSet& set = named_set(command.set);
        if (command.samplers.empty()) command.samplers = set.samplers;
        if (command.integrands.empty()) command.integrands = set.integrands;
    }
    refuse_unknown(command.integrands);
    std::vector<std::string> samplers = command.samplers;
    if (samplers.empty())
        for (const SamplerInfo& info : registry.infos()) samplers.push_back(info.name);
    nlohmann::ordered_json table = nlohmann::ordered_json::array();
    bool header = false;
    for (const std::string& name : samplers) {
        std::unique_ptr<SamplerFactory> factory;
        try {
            factory = make_sampler(registry, name);
        } catch (const UsageError&) {
            if (!command.samplers.empty()) throw;
            fmt::print(stderr, "koksma: '{}' is left out: it needs options\n", name);
            continue;
        }
        if (!factory->randomized()) throw UsageError(fmt::format("'{}' is not randomized: it has one error and no rate", factory->name()));
        std::vector<Rates> rates;
        try {
            rates = all_rates(*factory, command.integrands, command.most, command.replicates);
        } catch (const UsageError& e) {
            if (!command.samplers.empty()) throw;
            fmt::print(stderr, "koksma: {}\n", e.what());
            continue;
        }
        if (command.json) {
            nlohmann::ordered_json rows = nlohmann::ordered_json::array();
            for (const Rates& r : rates) rows.push_back(json_of(r));
            table.push_back({{"sampler", factory->name()}, {"replicates", command.replicates}, {"rates", rows}});
            continue;
        }
        if (!std::exchange(header, true)) {
            fmt::print("slope of log RMSE against log N with a 95 % interval; N from 64 to {} at good counts, {} replicates\n{:<34}", command.most, command.replicates, "sampler");
            for (const Rates& r : rates) fmt::print("{:>16}", label(r.integrand));
            fmt::print("\n");
        }
        fmt::print("{:<34}", factory->name());
        for (const Rates& r : rates) fmt::print("{:>16}", slope_text(r));
        fmt::print("\n");
        std::fflush(stdout);
    }
    if (command.json) fmt::print("{}\n", table.dump(2));
    return 0;
}

}  // namespace koksma
