#include "limits.h"
#include "progress.h"
#include "spread.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <atomic>
#include <chrono>
#include <thread>

namespace koksma {

namespace {

double seconds_now() { return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count(); }

/// Arithmetic that touches no memory: what the machine itself gives to that many threads, at this moment.
/// @return  seconds of wall time
double calibrate(int threads, int pieces) {
    std::atomic<int> next = 0;
    std::atomic<std::uint64_t> sink = 0;
    const auto work = [&] {
        std::uint64_t total = 0;
        while (next.fetch_add(1) < pieces) {
            float x[8] = {1.0f, 1.1f, 1.2f, 1.3f, 1.4f, 1.5f, 1.6f, 1.7f};
            for (int i = 0; i < 200'000; ++i)
                for (float& v : x) v = v * 0.999f + 0.5f / (v + 1.0f);
            for (const float v : x) total += static_cast<std::uint64_t>(v * 1000.0f);
        }
        sink += total;
    };
    const double start = seconds_now();
    std::vector<std::jthread> helpers;
    for (int i = 1; i < threads; ++i) helpers.emplace_back(work);
    work();
    helpers.clear();
    return seconds_now() - start;
}

}  // namespace

nlohmann::ordered_json measure_scaling(const LimitsCommand& command, const SceneSetup& setup) {
    const std::unique_ptr<SampleSource> source = setup.bind();
    const auto wall = [&](int threads) {
        RenderOptions o;
        o.threads = threads;
        if (!command.kernel.empty()) o.kernel = &find_kernel(command.kernel, setup.plan.effects);
        return render(setup.scene, setup.plan, *source, {setup.rect(), 0, setup.spp}, o).stats.wall_seconds;
    };
    static_cast<void>(wall(command.threads));
    // The calibration takes about as long as the render: both see the same disturbances.
    const double one_piece = calibrate(1, 8) / 8.0;
    const int pieces = std::max(16, static_cast<int>(wall(1) / one_piece));
    std::vector<double> render, arithmetic, ratio;
    {
        Progress progress("limits", true);
        for (int round = 0; round < command.rounds; ++round) {
            // A-B-B-A: a slow drift of the machine falls out.
            const double c1 = calibrate(1, pieces), r1 = wall(1), rn = wall(command.threads), cn = calibrate(command.threads, pieces);
            render.push_back(r1 / rn);
            arithmetic.push_back(c1 / cn);
            ratio.push_back(render.back() / arithmetic.back());
            progress.update((round + 1.0) / command.rounds);
        }
    }
    nlohmann::ordered_json figures = {{"threads", command.threads}};
    const auto line = [&](const char* what, const char* key, const std::vector<double>& values) {
        const Spread s = spread_of(values);
        fmt::print("  {:<46}{:.3f} [{:.3f}, {:.3f}]\n", what, s.median, s.lowest, s.highest);
        figures[key] = {{"median", s.median}, {"min", s.lowest}, {"max", s.highest}};
    };
    fmt::print("  {} threads against 1, wall time, median of {} rounds [min, max]\n", command.threads, command.rounds);
    line("speed-up of rendering", "render", render);
    line("speed-up of pure arithmetic at the same time", "arithmetic", arithmetic);
    line("ratio of the two", "ratio", ratio);
    return figures;
}

}  // namespace koksma
