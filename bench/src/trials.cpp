#include "trials.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <set>

namespace koksma {

namespace {

/// 0 where the sampler is not run at this count.
int replicates_at(const std::vector<Count>& counts, std::uint64_t spp) {
    for (const Count& c : counts)
        if (c.spp == spp) return c.replicates;
    return 0;
}

}  // namespace

Shard shard_of(const std::string& text) {
    Shard shard;
    const char *end = text.data() + text.size(), *slash = std::find(text.data(), end, '/');
    const auto number = [](const char* from, const char* to, int& value) {
        const auto [stop, error] = std::from_chars(from, to, value);
        return error == std::errc{} && stop == to && from != to;
    };
    if (slash == end || !number(text.data(), slash, shard.part) || !number(slash + 1, end, shard.of) || shard.part < 1 || shard.part > shard.of || shard.of > 10000)
        throw UsageError(fmt::format("--shard {}: expected k/n with 1 <= k <= n, as in 1/3", text));
    return shard;
}

std::vector<PlannedTrial> trials_of(const Run& run, Shard shard) {
    std::vector<std::vector<Count>> counts;
    std::set<std::uint64_t> all_spp;
    for (const auto& sampler : run.samplers) {
        counts.push_back(counts_of(run.experiment, sampler->info()));
        for (const Count& c : counts.back()) all_spp.insert(c.spp);
    }
    const int most = *std::max_element(run.experiment.replicates.begin(), run.experiment.replicates.end());
    std::vector<PlannedTrial> trials;
    std::vector<double> load(static_cast<std::size_t>(shard.of), 0.0);
    const auto mine = [&](std::uint64_t spp) {
        const auto least = std::min_element(load.begin(), load.end());  // the first of the least loaded: the same on all machines
        *least += static_cast<double>(spp);
        return least - load.begin() == shard.part - 1;
    };
    for (std::size_t first = 0, end = 0; first < run.scenes.size(); first = end) {
        // One scene under several sets of effects: side by side, since their times are compared.
        while (end < run.scenes.size() && run.scenes[end].what.file == run.scenes[first].what.file) ++end;
        for (int replicate = 0; replicate < most; ++replicate)
            for (const std::uint64_t spp : all_spp)
                for (std::size_t k = 0; k < run.samplers.size(); ++k) {
                    if (replicate >= replicates_at(counts[k], spp)) continue;
                    if (replicate > 0 && !run.samplers[k]->randomized()) continue;  // it would be the same render again
                    for (std::size_t scene = first; scene < end; ++scene)
                        for (std::size_t layout = 0; layout < run.orders[scene].size(); ++layout)
                            if (mine(spp))
                                trials.push_back({scene, k, {spp, replicate, static_cast<int>(layout), &run.orders[scene][layout], 0}});
                }
        // Each prefix is rendered from its first sample, so that a row needs no other: with counts times 4 it costs a third more.
        for (int replicate = 0; replicate < run.experiment.progressive; ++replicate)
            for (const std::uint64_t spp : run.experiment.spp)
                for (std::size_t k = 0; k < run.samplers.size(); ++k)
                    for (std::size_t scene = first; scene < end; ++scene)
                        if (run.samplers[k]->randomized() && mine(spp))
                            trials.push_back({scene, k, {spp, replicate, 0, &run.orders[scene][0], run.experiment.spp.back()}});
    }
    return trials;
}

double samples_of(const std::vector<PlannedTrial>& trials) {
    double sum = 0;
    for (const PlannedTrial& t : trials) sum += static_cast<double>(t.trial.spp);
    return sum;
}

}  // namespace koksma
