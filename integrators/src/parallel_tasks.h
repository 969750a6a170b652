#pragma once
// Work for all threads, in numbered pieces.

#include <koksma/integrators/happens_before.h>

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/partitioner.h>
#include <tbb/task_arena.h>

#include <cstddef>

namespace koksma::detail {

/// Calls run(i) once for each i in [0, count), at the same time and in any order, and returns when all have.
/// @param threads  0: as many as TBB has
template <class F>
void for_each_task(std::size_t count, int threads, const F& run) {
    HappensBefore fork, join;
    fork.announce();
    tbb::task_arena arena(threads > 0 ? threads : tbb::task_arena::automatic);
    arena.execute([&] {
        tbb::parallel_for(
            tbb::blocked_range<std::size_t>(0, count, 1),
            [&](const auto& range) {
                for (std::size_t i = range.begin(); i != range.end(); ++i) {
                    fork.await();
                    run(i);
                    join.announce();
                }
            },
            tbb::simple_partitioner());
    });
    join.await();
}

}  // namespace koksma::detail
