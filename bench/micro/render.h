#pragma once
// The parts of koksma_micro_render, one function each to register its benchmarks.

#include <benchmark/benchmark.h>

#include <cstdint>

namespace koksma::micro {

void register_queries();
void register_bsdfs();
void register_kernels();

/// Counts work, and says how much CPU time a piece takes.
inline void count(benchmark::State& state, std::uint64_t pieces, const char* name) {
    const auto all = static_cast<double>(state.iterations()) * static_cast<double>(pieces);
    state.SetItemsProcessed(static_cast<std::int64_t>(all));
    state.counters[name] = benchmark::Counter(all, benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
}

}  // namespace koksma::micro
