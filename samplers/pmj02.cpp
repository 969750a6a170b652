#include "pmj02.h"

namespace koksma {
namespace {

constexpr std::uint16_t kCoordinates[] = {
#include "data/pmj02_best.inc"
};
static_assert(sizeof(kCoordinates) == kPmjTables * kPmjPoints * 2 * sizeof(std::uint16_t));

Pmj02Sampler::Randomize parse(const std::string& name) {
    if (name == "none") return Pmj02Sampler::Randomize::none;
    if (name == "cp") return Pmj02Sampler::Randomize::shift;
    return name == "xor" ? Pmj02Sampler::Randomize::digital_shift : Pmj02Sampler::Randomize::owen;
}

}  // namespace

const std::uint16_t* pmj_tables() noexcept { return kCoordinates; }

/// The table of a slot, and its order: the points [2^m, 2^(m+1)) change places among themselves, halves of them and halves
/// of those as by a nested permutation. The first 2^m points stay the first 2^m, which alone are nets and well spaced.
const std::uint16_t* Pmj02Sampler::Point::entry(std::uint32_t dimension) const noexcept {
    if (randomize_ == Randomize::none && dimension == 0) return tables_ + 2 * index_;
    const std::uint32_t leading = std::bit_floor(index_), below = leading == 0 ? 0 : leading - 1;
    const std::uint32_t shuffled = reverse_bits(owen_hash_rev(reverse_bits(index_), keyed_hash(orders_, dimension)));
    const auto table = static_cast<std::uint32_t>((std::uint64_t{keyed_hash(derive_key(orders_, 1), dimension)} * kPmjTables) >> 32);
    return tables_ + 2 * (table * kPmjPoints + (leading | (shuffled & below)));
}

/// Digits below 2^-16, which the tables do not have, are drawn for each sample: common ones would be a common error.
float Pmj02Sampler::Point::value(std::uint32_t leading, std::uint32_t dimension) const noexcept {
    std::uint32_t x = leading << 16;
    if (randomize_ == Randomize::none) return unit_float(x);
    x |= keyed_hash(fine_, dimension) >> 16;
    switch (randomize_) {
        case Randomize::shift: return unit_float(x + keyed_hash(values_, dimension));
        case Randomize::owen: return unit_float(reverse_bits(owen_hash_rev(reverse_bits(x), keyed_hash(values_, dimension))));
        default: return unit_float(x ^ keyed_hash(values_, dimension));
    }
}

SamplerInfo Pmj02Sampler::info() {
    return {.name = "pmj02",
            .title = "PMJ02, best candidates",
            .paper = "Christensen, Kensler and Kilpatrick 2018, Progressive multi-jittered sample sequences",
            .options = {{.name = "randomize",
                         .default_value = "xor",
                         .values = {"none", "cp", "xor", "owen"},
                         .help = "nothing, shift modulo 1 (keeps distances, loses strata), digital shift, nested scrambling (both keep strata)",
                         .always_shown = true},
                        pixels_option()},
            .joint = 2,
            .good_counts = {.rule = GoodCounts::Rule::power, .base = 2},
            .remark = "finite tables",
            .max_samples = kPmjPoints};
}

Pmj02Sampler::Pmj02Sampler(const SamplerOptions& options, const SamplingPlan& plan)
    : keys_(options, plan, 0x706d6a3032ull), randomize_(parse(options["randomize"])) {}

}  // namespace koksma
