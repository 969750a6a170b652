#include "faure.h"

#include "stratum.h"

#include <string>

namespace koksma {
namespace {

/// d -> a d + e modulo a prime base. With a != 0 and e from a hash, the images of one digit, and of any two digits, are as
/// likely as under a uniformly random permutation; variances of scrambled estimates depend on nothing more.
std::uint32_t permuted_digit(const FaureBase& b, std::uint32_t digit, std::uint64_t hash) noexcept {
    const auto a = 1 + static_cast<std::uint32_t>(((hash & 0xffffffu) * (b.base - 1)) >> 24);
    const auto e = static_cast<std::uint32_t>((((hash >> 24) & 0xffffffu) * b.base) >> 24);
    return b.remainder(a * digit + e);
}

/// As above with e = 0: zero stays.
std::uint32_t permuted_nonzero(const FaureBase& b, std::uint32_t digit, std::uint64_t hash) noexcept {
    return b.remainder((1 + static_cast<std::uint32_t>(((hash & 0xffffffu) * (b.base - 1)) >> 24)) * digit);
}

FaureSampler::Randomize parse(const std::string& name) {
    if (name == "none") return FaureSampler::Randomize::none;
    return name == "digits" ? FaureSampler::Randomize::digits : FaureSampler::Randomize::owen;
}

std::uint32_t parse_base(const std::string& text) {
    for (const std::uint32_t b : {3u, 5u, 7u, 11u, 13u})
        if (text == std::to_string(b)) return b;
    throw Error("sampler 'faure': base=" + text + " is not one of its bases: 3, 5, 7, 11, 13");
}

}  // namespace

FaureBase::FaureBase(std::uint32_t b)
    : base(b), reciprocal((0xffffu + b) / b) {
    for (std::uint64_t n = 1; n < kMaxStrata; n *= b, ++digits)
        if (8 * n <= kMaxStrata) cells = n, kept = digits;
    for (std::uint32_t r = kept; r < digits; ++r) rest_scale /= b;
    scale = 0x1p24 / static_cast<double>(cells);
    for (std::uint64_t n = ~std::uint64_t{0}; n != 0; n /= b) ++columns;
    // Dimension j: digit r of a point is the sum over c >= r of C(c, r) j^(c - r) a_c, with a_c digit c of the index.
    std::vector<std::uint32_t> binomial(columns * columns, 0);
    for (std::uint32_t c = 0; c < columns; ++c)
        for (std::uint32_t r = 0; r <= c; ++r)
            binomial[c * columns + r] = r == 0 || r == c ? 1 : (binomial[(c - 1) * columns + r - 1] + binomial[(c - 1) * columns + r]) % b;
    table.resize(std::size_t{b} * columns * b);
    for (std::uint32_t j = 0; j < b; ++j)
        for (std::uint32_t c = 0; c < columns; ++c)
            for (std::uint32_t r = 0; r <= c && r < digits; ++r) {
                std::uint32_t entry = binomial[c * columns + r];
                for (std::uint32_t k = r; k < c; ++k) entry = entry * j % b;
                for (std::uint32_t a = 0; a < b; ++a)
                    table[(std::size_t{j} * columns + c) * b + a][r / 8] |= std::uint64_t{entry * a % b} << (8 * (r % 8));
            }
}

FaureSampler::Tables::Tables(const SamplerOptions& options) : base(parse_base(options["base"])) {}

void FaureSampler::Tables::describe(SamplerInfo& info) const {
    info.joint = base.base;
    info.good_counts.base = base.base;
}

/// The order of a set is a nested permutation of the index: each digit is permuted, by one chosen by the digits above it. Zeros
/// above the leading digit stay: permuting them too would only add the same digits to all points, which a scramble hides.
template <std::size_t arity>
void FaureSampler::Point::values(std::uint32_t dimension, float (&out)[arity]) const noexcept {
    const FaureBase& b = *sampler_->base_;
    const JointPlace place = sampler_->places_[dimension];
    const bool in_order = sampler_->randomize_ == Randomize::none && place.set == 0;
    const std::uint64_t key = mix64(orders_ ^ place.set);
    const FaureBase::Digits* column = b.table.data() + std::size_t{place.within} * b.columns * b.base;
    const std::size_t next_dimension = std::size_t{b.columns} * b.base;
    FaureBase::Digits sum[arity]{};
    std::uint64_t c = 0;
    for (std::uint64_t n = index_; n != 0; column += b.base, ++c) {
        const std::uint64_t above = n >> 32 ? n / b.base : static_cast<std::uint32_t>(n) / b.base;
        auto digit = static_cast<std::uint32_t>(n - above * b.base);
        if (!in_order) {
            const std::uint64_t hash = mix64(key ^ (c << 58) ^ above);
            digit = above == 0 ? permuted_nonzero(b, digit, hash) : permuted_digit(b, digit, hash);
        }
        for (std::size_t k = 0; k < arity; ++k)
            for (std::size_t half = 0; half < 2; ++half) sum[k][half] += column[k * next_dimension + digit][half];
        n = above;
    }
    for (std::size_t k = 0; k < arity; ++k) out[k] = value(sum[k], dimension + static_cast<std::uint32_t>(k));
}

template void FaureSampler::Point::values(std::uint32_t, float (&)[1]) const noexcept;
template void FaureSampler::Point::values(std::uint32_t, float (&)[2]) const noexcept;

/// Digits are permuted to the last that a float can tell apart, so also the zeros that follow those of the index.
float FaureSampler::Point::value(const FaureBase::Digits& sum, std::uint32_t dimension) const noexcept {
    const FaureBase& b = *sampler_->base_;
    const Randomize randomize = sampler_->randomize_;
    const std::uint64_t key = mix64(values_ ^ dimension);
    std::uint64_t before = 0, cell = 0;
    std::uint32_t finer = 0;
    double rest = 0;
    for (std::uint32_t r = 0; r < b.digits; ++r) {
        const std::uint32_t digit = b.remainder((sum[r / 8] >> (8 * (r % 8))) & 255u);
        std::uint32_t image = digit;
        if (randomize != Randomize::none) {
            const std::uint64_t hash = mix64(key ^ ((std::uint64_t{r} << 32) | before));
            image = permuted_digit(b, digit, hash);
            rest = static_cast<double>(static_cast<std::int64_t>(hash >> 56)) * 0x1p-8;
        }
        if (r < b.kept)
            cell = cell * b.base + image;
        else
            finer = finer * b.base + image;
        if (randomize == Randomize::owen) before = before * b.base + digit;
    }
    return stratum_float(cell, b.cells, b.scale, (finer + rest) * b.rest_scale);
}

SamplerInfo FaureSampler::info() {
    return {.name = "faure",
            .title = "Faure",
            .paper = "Faure 1982, Discrepance de suites associees a un systeme de numeration",
            .options = {{.name = "randomize",
                         .default_value = "owen",
                         .values = {"none", "digits", "owen"},
                         .help = "nothing, a permutation per digit place, nested permutations",
                         .always_shown = true},
                        {.name = "base", .default_value = "5", .values = {}, .help = "3, 5, 7, 11 or 13: also the size of a set of dimensions"},
                        pixels_option()},
            .joint = 5,
            .good_counts = {.rule = GoodCounts::Rule::power, .base = 5}};
}

FaureSampler::FaureSampler(const SamplerOptions& options, const SamplingPlan& plan, const Tables& tables)
    : keys_(options, plan, 0x6661757265ull), base_(&tables.base), places_(joint_sets(plan.layout, tables.base.base, false)),
      randomize_(parse(options["randomize"])) {}

}  // namespace koksma
