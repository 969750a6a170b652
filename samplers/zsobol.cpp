#include "zsobol.h"

#include <algorithm>

namespace koksma {

SamplerInfo ZSobolSampler::info() {
    return {.name = "zsobol",
            .title = "Z-order Sobol'",
            .paper = "Ahmed and Wonka 2020, Screen-space blue-noise diffusion of Monte Carlo sampling error via hierarchical ordering of pixels",
            .options = {{.name = "randomize",
                         .default_value = "owen",
                         .values = {"xor", "owen"},
                         .help = "digital shift, nested scrambling by a hash, one for the image; both with the order of the pixels permuted",
                         .always_shown = true}},
            .kind = SamplerKind::set,
            .scope = SamplerScope::image,
            .joint = 2,
            .good_counts = {.rule = GoodCounts::Rule::power, .base = 2},
            .remark = "other counts take the first samples of the next power of two; films up to 65536 pixels a side",
            .max_samples = std::uint64_t{1} << 32};
}

ZSobolSampler::ZSobolSampler(const SamplerOptions& options, const SamplingPlan& plan)
    : sample_bits_(ceil_log2(std::max<std::uint64_t>(with_film_checked(options, plan).spp, 1))),
      bits_(2 * ceil_log2(static_cast<std::uint64_t>(std::max(plan.film_width, plan.film_height))) + sample_bits_),
      order_key_(pixel_key(plan.seed ^ 0x7a736f626f6cull, {})),
      value_key_(derive_key(order_key_, 0x76616c756573ull)),
      owen_(options["randomize"] == "owen") {}

}  // namespace koksma
