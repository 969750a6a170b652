// A render flushes denormals in its tasks and leaves every thread as it found it: the caller's, and TBB's workers.

#include "traced.h"

#include <tbb/parallel_for.h>

#include <atomic>
#include <limits>

using namespace koksma;
using namespace koksma::testing;

namespace {

bool flushes() {
    volatile float least = std::numeric_limits<float>::denorm_min(), one = 1.0f;
    return least * one == 0.0f;
}

/// How many of many tasks ran on a thread that flushes.
int flushing_tasks() {
    std::atomic<int> n = 0;
    tbb::parallel_for(0, 256, [&](int) {
        if (flushes()) ++n;
        volatile int work = 0;
        for (int i = 0; i < 20000; ++i) work = work + i;  // long enough for all workers to take part
    });
    return n;
}

}  // namespace

TEST_CASE("the host's floating-point state survives a render", "[kernels]") {
    REQUIRE(flushing_tasks() == 0);
    const Ready ready(load_scene(std::filesystem::path(KOKSMA_SOURCE_DIR) / "scenes/cornell.xml", {{"res", "64"}}));
    for (const bool batch : {true, false}) {
        RenderOptions o;
        o.kernel = family(ready.plan.effects, batch).front();
        for (const int threads : {1, 2, 0}) {
            o.threads = threads;
            INFO(o.kernel->name << " with " << threads << " threads");
            REQUIRE_FALSE(flushes());
            const Film film = ready.render(kSobol, 8, 1, o).film;
            CHECK_FALSE(flushes());
            CHECK(flushing_tasks() == 0);
#if defined(__SSE__)
            const FlushDenormals flush;  // a host that flushes goes on flushing, and gets the same image
            REQUIRE(flushes());
            CHECK(same_bytes(film, ready.render(kSobol, 8, 1, o).film));
            CHECK(flushes());
#endif
        }
    }
}
