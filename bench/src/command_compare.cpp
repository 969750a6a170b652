#include "commands.h"

#include <koksma/film/exr.h>
#include <koksma/measure/flip.h>
#include <koksma/measure/metrics.h>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace koksma {

int run_compare(const CompareCommand& command) {
    const ExrImage a = read_exr(command.a), b = read_exr(command.b);
    if (a.width != b.width || a.height != b.height)
        throw Error(fmt::format("{} has {}x{} pixels, {} has {}x{}; they must agree", command.a.string(), a.width, a.height, command.b.string(), b.width, b.height));
    const ImageError e = compare_images(a.rgb(), b.rgb());
    const double flip = HdrFlip(b.rgb(), b.width, b.height).mean(a.rgb());
    if (command.json) {
        const nlohmann::ordered_json json = {{"a", command.a.string()},
                                             {"b", command.b.string()},
                                             {"width", a.width},
                                             {"height", a.height},
                                             {"mse", e.mse},
                                             {"rmse", e.rmse},
                                             {"relmse", e.relmse},
                                             {"mae", e.mae},
                                             {"smape", e.smape},
                                             {"flip", flip},
                                             {"max_abs", e.max_abs},
                                             {"mean_a", {e.mean_a[0], e.mean_a[1], e.mean_a[2]}},
                                             {"mean_b", {e.mean_b[0], e.mean_b[1], e.mean_b[2]}},
                                             {"non_finite_a", e.non_finite_a},
                                             {"non_finite_b", e.non_finite_b}};
        fmt::print("{}\n", json.dump(2));
        return 0;
    }
    fmt::print("RMSE      {:.6e}\nrelMSE    {:.6e}\nMAE       {:.6e}\nSMAPE     {:.6e}\nHDR-FLIP  {:.6e}\nlargest   {:.6e}\n", e.rmse, e.relmse, e.mae, e.smape, flip, e.max_abs);
    fmt::print("mean A    {:.6f} {:.6f} {:.6f}\nmean B    {:.6f} {:.6f} {:.6f}\n", e.mean_a[0], e.mean_a[1], e.mean_a[2], e.mean_b[0], e.mean_b[1], e.mean_b[2]);
    fmt::print("ratio A/B {:.6f} {:.6f} {:.6f}\n", e.mean_a[0] / e.mean_b[0], e.mean_a[1] / e.mean_b[1], e.mean_a[2] / e.mean_b[2]);
    if (!e.all_finite()) fmt::print("left out  {} pixels of A and {} of B that are not finite\n", e.non_finite_a, e.non_finite_b);
    return 0;
}

}  // namespace koksma
