#include "sobol_global.h"

#include <bit>
#include <utility>

namespace koksma {
namespace {

SobolSampler::Randomize parse(const std::string& name) {
    if (name == "none") return SobolSampler::Randomize::none;
    return name == "xor" ? SobolSampler::Randomize::digital_shift : SobolSampler::Randomize::owen;
}

}  // namespace

SobolEnumeration::SobolEnumeration(int width_bits, int height_bits) noexcept : width_bits_(width_bits), height_bits_(height_bits) {
    // The leading digits of y as functions of index bits [width_bits, width_bits + height_bits): a submatrix of the Pascal
    // matrix, invertible since dimensions 0 and 1 are a (0, 2)-sequence. Gauss-Jordan elimination; rows are index bits.
    std::array<std::pair<std::uint64_t, std::uint64_t>, 16> rows{};  // digits of y that a sum of index bits flips, and that sum
    for (int j = 0; j < height_bits; ++j) {
        const std::uint64_t bit = std::uint64_t{1} << (width_bits + j);
        rows[static_cast<std::size_t>(j)] = {pascal_rev(bit) & ((std::uint64_t{1} << height_bits) - 1), bit};
    }
    const auto size = static_cast<std::size_t>(height_bits);
    for (std::size_t digit = 0; digit < size; ++digit) {
        std::size_t pivot = digit;
        while (((rows[pivot].first >> digit) & 1u) == 0) ++pivot;
        std::swap(rows[digit], rows[pivot]);
        for (std::size_t j = 0; j < size; ++j)
            if (j != digit && ((rows[j].first >> digit) & 1u) != 0) {
                rows[j].first ^= rows[digit].first;
                rows[j].second ^= rows[digit].second;
            }
    }
    for (std::size_t digit = 0; digit < size; ++digit) solution_[digit] = rows[digit].second;
}

std::uint64_t SobolEnumeration::index(Pixel pixel, std::uint64_t n) const noexcept {
    // Shifts in two steps: the number of bits may be 0.
    const std::uint64_t column = reverse_bits64(static_cast<std::uint32_t>(pixel.x)) >> 1 >> (63 - width_bits_);
    const std::uint64_t row = reverse_bits64(static_cast<std::uint32_t>(pixel.y)) >> 1 >> (63 - height_bits_);
    std::uint64_t index = (n << (width_bits_ + height_bits_)) | column;
    std::uint64_t wrong = (pascal_rev(index) ^ row) & ((std::uint64_t{1} << height_bits_) - 1);
    for (; wrong != 0; wrong &= wrong - 1) index ^= solution_[static_cast<std::size_t>(std::countr_zero(wrong))];
    return index;
}

glm::vec2 SobolGlobalSampler::film(Pixel pixel, std::uint64_t index) const noexcept {
    SobolEnumeration::Position p = enumeration_.within_pixel(index);
    switch (randomize_) {
        case SobolSampler::Randomize::none: break;
        case SobolSampler::Randomize::digital_shift:
            p.x_rev ^= keyed_hash(key_, 0);
            p.y_rev ^= keyed_hash(key_, 1);
            break;
        default:  // nested: what is below a pixel's digits depends on them
            p.x_rev = owen_hash_rev(p.x_rev, keyed_hash(derive_key(key_, static_cast<std::uint32_t>(pixel.x)), 0));
            p.y_rev = owen_hash_rev(p.y_rev, keyed_hash(derive_key(key_, static_cast<std::uint32_t>(pixel.y)), 1));
    }
    return {unit_float(reverse_bits(p.x_rev)), unit_float(reverse_bits(p.y_rev))};
}

SamplerInfo SobolGlobalSampler::info() {
    return {.name = "sobol-global",
            .title = "Sobol' over the image",
            .paper = "Gruenschloss, Raab and Keller 2012, Enumerating quasi-Monte Carlo point sequences in elementary intervals",
            .options = {{.name = "randomize",
                         .default_value = "owen",
                         .values = {"none", "xor", "owen"},
                         .help = "nothing, digital shift, nested scrambling by a hash; one for the image, below the pixel's digits on the film",
                         .always_shown = true}},
            .scope = SamplerScope::image,
            .joint = 0,
            .good_counts = {.rule = GoodCounts::Rule::power, .base = 2},
            .remark = "films up to 65536 pixels a side",
            .max_dimensions = kSobolDimensions - 2,
            .max_samples = std::uint64_t{1} << 32};
}

SobolGlobalSampler::SobolGlobalSampler(const SamplerOptions& options, const SamplingPlan& plan)
    : matrices_(sobol_matrices()),
      enumeration_(ceil_log2(static_cast<std::uint64_t>(with_film_checked(options, plan).film_width)), ceil_log2(static_cast<std::uint64_t>(plan.film_height))),
      dimensions_(plan.layout),
      key_(pixel_key(plan.seed ^ 0x736f626f6c2d67ull, {})),
      randomize_(parse(options["randomize"])) {}

}  // namespace koksma
