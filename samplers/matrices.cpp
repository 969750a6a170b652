#include "matrices.h"

#include "data_file.h"
#include "index_shuffle.h"
#include "stratum.h"

#include <algorithm>
#include <array>
#include <limits>

namespace koksma {
namespace {

constexpr std::uint32_t kMostDigits = 24;  // base 2 needs 24 to tell floats apart; all others fewer

/// d -> a d + e modulo the base, a != 0: the images of one digit, and of any two, are as likely as under a uniformly random
/// permutation; variances of scrambled estimates depend on nothing more.
std::uint32_t permuted_digit(const HaltonBase& b, std::uint32_t digit, std::uint64_t hash, bool keep_zero = false) noexcept {
    const auto a = 1 + static_cast<std::uint32_t>(((hash & 0x3fffffffu) * (b.base - 1)) >> 30);
    const auto e = keep_zero ? 0 : static_cast<std::uint32_t>((((hash >> 30) & 0x3ffffffu) * b.base) >> 26);
    const std::uint32_t y = a * digit + e;  // below 2^27
    return y - b.quotient(y) * b.base;
}

MatricesSampler::Randomize parse(const std::string& name) {
    if (name == "none") return MatricesSampler::Randomize::none;
    return name == "digits" ? MatricesSampler::Randomize::digits : MatricesSampler::Randomize::owen;
}

}  // namespace

MatricesSampler::Tables::Tables(const SamplerOptions& options) : file_(options["file"]), pad_(options["pad"]) {
    if (file_ == kBuiltInFile) {
        check_no_checksum(options);
        base_ = halton_bases();
        dimensions_ = kSobolDimensions;
        rows_ = 32;
        columns_ = 64;
        count_ = std::numeric_limits<std::uint64_t>::max();
        nibbles_ = sobol_matrices();
        return;
    }
    const std::string bytes = read_data_file(file_);
    checksum_ = checksum_of(bytes);
    check_checksum(options, file_, checksum_);
    const GeneratorMatrices m = GeneratorMatrices::parse(bytes, file_);
    dimensions_ = m.dimensions;
    rows_ = m.rows;
    columns_ = m.columns;
    count_ = m.point_count();
    stratified_ = m.stratified;
    base_ = halton_bases() + (std::lower_bound(kPrimes.begin(), kPrimes.end(), m.base) - kPrimes.begin());
    m.base == 2 ? make_binary(m) : make_digits(m);
}

void MatricesSampler::Tables::make_binary(const GeneratorMatrices& m) {
    own_.resize(std::size_t{m.dimensions} * kSobolNibbles);
    nibbles_ = own_.data();
    for (std::size_t d = 0; d < m.dimensions; ++d)
        for (std::size_t c = 0; c < m.columns; ++c) {
            std::uint32_t column_rev = 0;  // rows beyond the 32nd are below the last bit of a float
            for (std::size_t r = 0; r < std::min<std::size_t>(m.rows, 32); ++r) column_rev |= m.entry(d, r, c) << r;
            auto& entries = own_[d * kSobolNibbles + c / 4].entry_rev;
            for (std::size_t j = 0; j < 16; ++j)
                if ((j >> (c % 4)) & 1u) entries[j] ^= column_rev;
        }
}

void MatricesSampler::Tables::make_digits(const GeneratorMatrices& m) {
    const std::size_t kept = base_->digits;  // the last row that a float can tell apart; missing rows are zero
    digits_.resize(std::size_t{m.dimensions} * m.columns * kept, 0);
    for (std::size_t d = 0; d < m.dimensions; ++d)
        for (std::size_t c = 0; c < m.columns; ++c)
            for (std::size_t r = 0; r < std::min<std::size_t>(m.rows, kept); ++r)
                digits_[(d * m.columns + c) * kept + r] = static_cast<std::uint16_t>(m.entry(d, r, c));
}

void MatricesSampler::Tables::describe(SamplerInfo& info) const {
    info.max_samples = count_;
    describe_padding(pad_, dimensions_, info);
    info.good_counts = stratified_ ? GoodCounts{.rule = GoodCounts::Rule::power, .base = base_->base} : GoodCounts{};
    info.remark = (file_ == kBuiltInFile ? "built-in matrices of Sobol'" : file_ + ", checksum " + checksum_) + ": base " + std::to_string(base_->base) + ", " +
                  std::to_string(dimensions_) + " dimensions, " + std::to_string(rows_) + " rows, " + std::to_string(columns_) + " columns" +
                  (stratified_ ? "" : "; not every dimension is stratified");
}

/// Sets after the first have an order of their own: a nested permutation of the index, which maps the first b^m samples onto
/// themselves (base 2: onto an aligned block), so whatever they are good for they still are.
std::uint64_t MatricesSampler::Point::ordered(std::uint32_t set) const noexcept {
    if (set == 0) return index_;
    const Tables& t = *sampler_->tables_;
    const HaltonBase& b = *t.base_;
    if (b.base == 2) return t.columns_ < 32 ? shuffled_index(index_ << (32 - t.columns_), orders_, set) >> (32 - t.columns_) : shuffled_index(index_, orders_, set);
    const std::uint64_t key = mix64(join_key(orders_) ^ set);
    std::uint64_t result = 0, weight = 1, place = 0;
    for (std::uint64_t n = index_; n != 0; weight *= b.base, ++place) {
        const std::uint64_t above = b.quotient(n);
        const auto digit = static_cast<std::uint32_t>(n - above * b.base);
        result += weight * permuted_digit(b, digit, mix64(key ^ (place << 58) ^ above), above == 0);
        n = above;
    }
    return result;
}

float MatricesSampler::Point::value(std::uint64_t index, std::uint32_t row, std::uint32_t dimension) const noexcept {
    const Tables& t = *sampler_->tables_;
    if (t.nibbles_ == nullptr) return value_of_digits(index, row, dimension);
    std::uint32_t x_rev = sobol_rev(t.nibbles_, index, row);
    if (sampler_->randomize_ == Randomize::digits) x_rev ^= keyed_hash(values_, dimension);
    if (sampler_->randomize_ == Randomize::owen) x_rev = owen_hash_rev(x_rev, keyed_hash(values_, dimension));
    return unit_float(reverse_bits(x_rev));
}

float MatricesSampler::Point::value_of_digits(std::uint64_t index, std::uint32_t row, std::uint32_t dimension) const noexcept {
    const Tables& t = *sampler_->tables_;
    const HaltonBase& b = *t.base_;
    std::array<std::uint64_t, kMostDigits> sum{};  // of at most 64 products of two numbers below 2^13
    const std::uint16_t* column = t.digits_.data() + std::size_t{row} * t.columns_ * b.digits;
    std::uint32_t c = 0;
    for (std::uint64_t n = index; n != 0 && c < t.columns_; ++c, column += b.digits) {
        const std::uint64_t above = b.quotient(n);
        const auto digit = static_cast<std::uint32_t>(n - above * b.base);
        for (std::uint32_t r = 0; r < b.digits; ++r) sum[r] += std::uint64_t{digit} * column[r];
        n = above;
    }
    // As for Halton: digits are permuted to the last that a float can tell apart, so also zeros.
    const Randomize randomize = sampler_->randomize_;
    const std::uint64_t key = mix64(digit_key_ ^ dimension);
    std::uint64_t before = 0, cell = 0;
    for (std::uint32_t r = 0;; ++r) {
        const auto digit = static_cast<std::uint32_t>(sum[r] - b.quotient(sum[r]) * b.base);
        std::uint32_t image = digit;
        double rest = 0;
        if (randomize != Randomize::none) {
            const std::uint64_t hash = mix64(key ^ (std::uint64_t{r} << 58) ^ before);
            image = permuted_digit(b, digit, hash);
            rest = static_cast<double>(static_cast<std::int64_t>(hash >> 56)) * 0x1p-8;
        }
        if (r + 1 == b.digits) return stratum_float(cell, b.cells, b.scale, (image + rest) * b.inverse_base);
        cell = cell * b.base + image;
        if (randomize == Randomize::owen) before = before * b.base + digit;
    }
}

SamplerInfo MatricesSampler::info() {
    return {.name = "matrices",
            .title = "Generator matrices",
            .paper = "Niederreiter 1987, Point sets and sequences with small discrepancy",
            .options = {{.name = "randomize",
                         .default_value = "owen",
                         .values = {"none", "digits", "owen"},
                         .help = "nothing, a permutation per digit place (base 2: digital shift), nested permutations",
                         .always_shown = true},
                        {.name = "file", .default_value = kBuiltInFile, .values = {}, .help = "text file of matrices; built-in: those of Sobol', 4096 dimensions"},
                        pad_option("none"),
                        checksum_option(),
                        pixels_option()},
            .joint = 0,
            .good_counts = {.rule = GoodCounts::Rule::power, .base = 2},
            .remark = "base, dimensions and counts are those of the file"};
}

MatricesSampler::MatricesSampler(const SamplerOptions& options, const SamplingPlan& plan, const Tables& tables)
    : keys_(options, plan, 0x6d61747269636573ull), tables_(&tables), places_(padded_places(options, plan.layout, tables.dimensions_)),
      randomize_(parse(options["randomize"])) {}

}  // namespace koksma
