#include "sobol.h"

#include <bit>
#include <cstddef>
#include <vector>

namespace koksma {
namespace {

// For dimensions 1, 2, ... (dimension 0 is the radical inverse): degree s of the primitive polynomial, its inner
// coefficients a, and the s initial numbers m_1 .. m_s.
constexpr std::uint16_t kJoeKuo[] = {
#include "data/joe_kuo_new6.inc"
};

using Columns = std::array<std::uint32_t, 64>;

/// The columns of one dimension, extended to 64 by the recurrence of the polynomial. Only the leading 32 digits are kept:
/// shifts to the right and xors never carry lower digits into them.
/// @param entry  the place in kJoeKuo, advanced past the dimension
/// Source: Joe and Kuo 2008, equation for v_{k,j}
Columns make_columns(const std::uint16_t*& entry) {
    Columns v{};
    const std::uint32_t degree = *entry++, polynomial = *entry++;
    for (std::uint32_t c = 0; c < degree; ++c) v[c] = std::uint32_t{*entry++} << (31 - c);
    for (std::uint32_t c = degree; c < v.size(); ++c) {
        v[c] = v[c - degree] ^ (v[c - degree] >> degree);
        for (std::uint32_t k = 1; k < degree; ++k)
            if ((polynomial >> (degree - 1 - k)) & 1u) v[c] ^= v[c - k];
    }
    return v;
}

std::vector<SobolNibble> make_matrices() {
    std::vector<SobolNibble> matrices(std::size_t{kSobolDimensions} * kSobolNibbles);
    const std::uint16_t* entry = kJoeKuo;
    for (std::uint32_t d = 0; d < kSobolDimensions; ++d) {
        Columns columns{};
        if (d == 0)
            for (std::uint32_t c = 0; c < 32; ++c) columns[c] = 0x80000000u >> c;
        else
            columns = make_columns(entry);
        for (std::uint32_t k = 0; k < kSobolNibbles; ++k) {
            auto& row = matrices[std::size_t{d} * kSobolNibbles + k].entry_rev;
            for (std::uint32_t j = 1; j < 16; ++j) {
                const auto lowest = static_cast<std::uint32_t>(std::countr_zero(j));
                row[j] = row[j & (j - 1)] ^ reverse_bits(columns[4 * k + lowest]);
            }
        }
    }
    return matrices;
}

SobolSampler::Randomize parse(const std::string& name) {
    if (name == "none") return SobolSampler::Randomize::none;
    if (name == "xor") return SobolSampler::Randomize::digital_shift;
    return name == "owen" ? SobolSampler::Randomize::owen : SobolSampler::Randomize::owen_tree;
}

}  // namespace

const SobolNibble* sobol_matrices() {
    static const std::vector<SobolNibble> matrices = make_matrices();
    return matrices.data();
}

std::uint32_t sobol_direction(std::uint32_t dimension, std::uint32_t column) {
    return reverse_bits(sobol_matrices()[std::size_t{dimension} * kSobolNibbles + column / 4].entry_rev[1u << (column % 4)]);
}

SamplerInfo SobolSampler::info() {
    return {.name = "sobol",
            .title = "Sobol'",
            .paper = "Joe and Kuo 2008, Constructing Sobol' sequences with better two-dimensional projections",
            .options = {{.name = "randomize",
                         .default_value = "owen",
                         .values = {"none", "xor", "owen", "owen-exact"},
                         .help = "nothing, digital shift, nested scrambling by a hash, nested scrambling by its definition (slow)",
                         .always_shown = true},
                        pixels_option()},
            .joint = 0,
            .good_counts = {.rule = GoodCounts::Rule::power, .base = 2},
            .max_dimensions = kSobolDimensions};
}

SobolSampler::SobolSampler(const SamplerOptions& options, const SamplingPlan& plan)
    : keys_(options, plan, 0x736f626f6cull), matrices_(sobol_matrices()), randomize_(parse(options["randomize"])) {}

}  // namespace koksma
