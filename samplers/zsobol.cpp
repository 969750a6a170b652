#include "zsobol.h"

#include <algorithm>

namespace koksma {
namespace {

/// The permutations of {0, 1, 2, 3}, two bits an image, that of 0 in the lowest.
constexpr std::array<std::uint8_t, 24> make_permutations() {
    std::array<std::uint8_t, 24> all{};
    std::size_t n = 0;
    for (unsigned a = 0; a < 4; ++a)
        for (unsigned b = 0; b < 4; ++b)
            for (unsigned c = 0; c < 4; ++c)
                if (a != b && a != c && b != c) all[n++] = static_cast<std::uint8_t>(a | (b << 2) | (c << 4) | ((6 - a - b - c) << 6));
    return all;
}
constexpr std::array<std::uint8_t, 24> kPermutations = make_permutations();

}  // namespace

std::uint64_t permute_digits4(std::uint64_t n, int bits, std::uint64_t key) noexcept {
    std::uint64_t above = 1, result = 0;  // the digits above, after a leading 1 that tells the levels apart
    int shift = bits;
    for (; shift >= 2;) {
        shift -= 2;
        const auto digit = static_cast<unsigned>(n >> shift) & 3u;
        const std::uint64_t choice = (std::uint64_t{static_cast<std::uint32_t>(mix64(key ^ above) >> 32)} * 24) >> 32;
        result = (result << 2) | ((kPermutations[choice] >> (2 * digit)) & 3u);
        above = (above << 2) | digit;
    }
    if (shift == 1) result = (result << 1) | ((n ^ (mix64(key ^ above) >> 63)) & 1u);
    return result;
}

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
