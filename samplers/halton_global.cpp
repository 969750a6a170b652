#include "halton_global.h"

namespace koksma {
namespace {

HaltonSampler::Randomize parse(const std::string& name) {
    if (name == "none") return HaltonSampler::Randomize::none;
    if (name == "cp") return HaltonSampler::Randomize::shift;
    return name == "digits" ? HaltonSampler::Randomize::digits : HaltonSampler::Randomize::owen;
}

}  // namespace

HaltonEnumeration::HaltonEnumeration(std::uint64_t width, std::uint64_t height) noexcept
    : column_bits_(ceil_log2(width)), columns_(std::uint64_t{1} << column_bits_) {
    for (; rows_ < height; rows_ *= 3) ++row_digits_;
    // The inverse of 2 modulo an odd number r is (r + 1) / 2.
    inverse_ = 1 % rows_;
    for (int i = 0; i < column_bits_; ++i) inverse_ = inverse_ * ((rows_ + 1) / 2) % rows_;
}

std::uint64_t HaltonEnumeration::index(Pixel pixel, std::uint64_t n) const noexcept {
    // The leading digits of a position are the trailing ones of the index, mirrored.
    const std::uint64_t column = (std::uint64_t{reverse_bits(static_cast<std::uint32_t>(pixel.x))} << column_bits_) >> 32;
    std::uint64_t row = 0, y = static_cast<std::uint32_t>(pixel.y);
    for (int digit = 0; digit < row_digits_; ++digit, y /= 3) row = row * 3 + y % 3;
    // column modulo 2^j and row modulo 3^k. No product is above 2^36.
    const std::uint64_t steps = (row + rows_ - column % rows_) % rows_ * inverse_ % rows_;
    return n * stride() + steps * columns_ + column;
}

glm::vec2 HaltonGlobalSampler::film(Pixel pixel, std::uint64_t index) const noexcept {
    Key column_key = key_, row_key = key_;
    if (randomize_ == HaltonSampler::Randomize::owen) {  // nested: what is below a pixel's digits depends on them
        column_key = derive_key(key_, static_cast<std::uint32_t>(pixel.x));
        row_key = derive_key(key_, static_cast<std::uint32_t>(pixel.y));
    }
    return {HaltonSampler::Point(bases_, column_key, enumeration_.column_index(index), randomize_).get_1d({.dimension = 0}),
            HaltonSampler::Point(bases_, row_key, enumeration_.row_index(index), randomize_).get_1d({.dimension = 1})};
}

SamplerInfo HaltonGlobalSampler::info() {
    return {.name = "halton-global",
            .title = "Halton over the image",
            .paper = "Gruenschloss, Raab and Keller 2012, Enumerating quasi-Monte Carlo point sequences in elementary intervals",
            .version = 2,
            .options = {{.name = "randomize",
                         .default_value = "owen",
                         .values = {"none", "cp", "digits", "owen"},
                         .help = "nothing, shift modulo 1, a permutation per digit place, nested permutations; one for the image, below the pixel's digits on the film",
                         .always_shown = true}},
            .scope = SamplerScope::image,
            .joint = 0,
            .remark = "films up to 65536 pixels a side",
            .max_dimensions = kPrimeCount - 2,
            .max_samples = std::uint64_t{1} << 30};  // times 2^16 3^11, the grid of the largest film: below 2^64
}

HaltonGlobalSampler::HaltonGlobalSampler(const SamplerOptions& options, const SamplingPlan& plan)
    : bases_(halton_bases()),
      enumeration_(static_cast<std::uint64_t>(with_film_checked(options, plan).film_width), static_cast<std::uint64_t>(plan.film_height)),
      dimensions_(plan.layout),
      key_(pixel_key(plan.seed ^ 0x68616c2d676c6f62ull, {})),
      randomize_(parse(options["randomize"])) {}

}  // namespace koksma
