// With one sample a pixel every randomised per-pixel sampler is one uniform point: the mean squared errors are equal.

#include "pixel_variance.h"

#include <koksma/scene/load.h>

#include <filesystem>

using namespace koksma;
using namespace koksma::testing;

TEST_CASE("at one sample a pixel all randomised per-pixel samplers have the error of random", "[scenes]") {
    // Parts of the picture without emitters or fireflies, whose few pixels would carry all of the error and none of the evidence.
    for (const char* scene : {"smooth", "cornell"}) {
        SceneDescription d = load_scene(std::filesystem::path(KOKSMA_SOURCE_DIR) / "scenes" / (std::string(scene) + ".xml"), {{"res", "64"}});
        d.film.crop_x = 20;
        d.film.crop_y = 40;
        d.film.crop_width = 24;
        d.film.crop_height = 20;
        const Ready ready(d);
        const std::vector<double> random = pixel_variances(ready, "random", 1, 64);
        for (const char* sampler : {"sobol:randomize=xor", "sobol:randomize=owen", "halton:randomize=cp", "halton:randomize=digits",
                                    "halton:randomize=owen", "stratified"}) {
            const std::vector<double> other = pixel_variances(ready, sampler, 1, 64);
            // Paired by pixel: both estimate the same variance there.
            std::vector<double> difference;
            double sum_random = 0, sum_other = 0;
            for (std::size_t i = 0; i < random.size(); ++i) {
                difference.push_back(other[i] - random[i]);
                sum_random += random[i];
                sum_other += other[i];
            }
            const Moments m = moments(difference);
            const double z = m.mean / std::sqrt(m.variance / m.n);
            INFO(scene << " " << sampler << ": MSE ratio to random " << sum_other / sum_random << ", z " << z);
            CHECK(std::fabs(z) < 6.0);
        }
    }
}
