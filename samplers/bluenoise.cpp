#include "bluenoise.h"

#include "data_file.h"

#include <algorithm>
#include <bit>
#include <charconv>
#include <cstddef>
#include <iterator>
#include <span>

namespace koksma {
namespace {

constexpr std::uint64_t kSalt = 0x626c75656e6f69ull;
constexpr std::uint32_t kVersion = 1, kHeader = 6;

constexpr std::uint32_t kBuiltIn[] = {
#include "data/bluenoise_64.inc"
};

BlueNoiseTile tile_of(std::span<const std::uint32_t> numbers, const std::string& file) {
    if (numbers.size() < kHeader) throw Error(file + ": has " + std::to_string(numbers.size()) + " numbers; a tile begins with six");
    if (numbers[0] != kVersion) throw Error(file + ": is of version " + std::to_string(numbers[0]) + "; this program reads version 1");
    BlueNoiseTile t{numbers[1], numbers[2], numbers[3], numbers[4], numbers[5]};
    for (const std::uint32_t side : {t.width, t.height})
        if (!std::has_single_bit(side) || side > 4096)
            throw Error(file + ": a side of the tile is " + std::to_string(side) + "; powers of two up to 4096 are possible");
    if (t.layers < 1 || t.layers > 64) throw Error(file + ": has " + std::to_string(t.layers) + " layers; 1 to 64 are possible");
    if (t.digits < 1 || t.digits > 16) throw Error(file + ": keys have " + std::to_string(t.digits) + " digits; 1 to 16 are possible");
    const std::uint64_t wanted = std::uint64_t{t.width} * t.height * t.layers;
    if (numbers.size() - kHeader != wanted)
        throw Error(file + ": has " + std::to_string(numbers.size() - kHeader) + " keys; " + std::to_string(t.width) + " x " + std::to_string(t.height) +
                    " pixels in " + std::to_string(t.layers) + " layers need " + std::to_string(wanted));
    t.keys.assign(numbers.begin() + kHeader, numbers.end());
    const std::uint32_t outside = 0xffffu << t.digits;
    for (const std::uint32_t key : t.keys)
        if (((key | (key >> 16)) & outside & 0xffffu) != 0)
            throw Error(file + ": the key " + std::to_string(key) + " has more than " + std::to_string(t.digits) + " digits");
    return t;
}

}  // namespace

BlueNoiseTile BlueNoiseTile::parse(std::string_view text, const std::string& file) {
    std::vector<std::uint32_t> numbers;
    Lines lines(text);
    for (std::string_view line; lines.next(line);) {
        line = line.substr(0, line.find("//"));
        for (std::string_view word = next_word(line); !word.empty(); word = next_word(line)) {
            std::uint32_t n = 0;
            const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), n);
            if (error != std::errc{} || end != word.data() + word.size())
                throw Error(file + ":" + std::to_string(lines.number()) + ": '" + std::string(word) + "' is not a number below 2^32");
            numbers.push_back(n);
        }
    }
    return tile_of(numbers, file);
}

BlueNoiseTile BlueNoiseTile::built_in() { return tile_of(kBuiltIn, "the tile of the program"); }

BlueNoiseSampler::Tables::Tables(const SamplerOptions& options) : file_(options["table"]) {
    if (file_ == kBuiltInFile) {
        check_no_checksum(options);
        tile_ = BlueNoiseTile::built_in();
        return;
    }
    const std::string bytes = read_data_file(file_);
    checksum_ = checksum_of(bytes);
    check_checksum(options, file_, checksum_);
    tile_ = BlueNoiseTile::parse(bytes, file_);
}

void BlueNoiseSampler::Tables::describe(SamplerInfo& info) const {
    info.remark = (file_ == kBuiltInFile ? "built-in tile" : file_ + ", checksum " + checksum_) + ": " + std::to_string(tile_.width) + " x " + std::to_string(tile_.height) +
                  " pixels, " + std::to_string(tile_.layers) + " layer(s), " + std::to_string(tile_.digits) + " digits, chosen for up to " +
                  std::to_string(tile_.samples) + " samples per pixel";
}

SamplerInfo BlueNoiseSampler::info() {
    return {.name = "bluenoise",
            .title = "Blue-noise Sobol'",
            .paper = "Heitz et al. 2019, A low-discrepancy sampler that distributes Monte Carlo errors as a blue noise in screen space",
            .options = {{.name = "randomize",
                         .default_value = "owen",
                         .values = {"owen"},
                         .help = "nested scrambling by a hash, one for the image and each dimension, after the keys of the pixels",
                         .always_shown = true},
                        {.name = "table", .default_value = kBuiltInFile, .values = {}, .help = "file of keys made by make_bluenoise; built-in: 64 x 64 pixels, chosen for up to 64 samples"},
                        checksum_option()},
            .scope = SamplerScope::tile,
            .joint = 2,
            .good_counts = {.rule = GoodCounts::Rule::power, .base = 2},
            .remark = "the arrangement is chosen for counts up to that of the table; beyond, errors of neighbours are as good as independent"};
}

BlueNoiseSampler::BlueNoiseSampler(const SamplerOptions&, const SamplingPlan& plan, const Tables& tables)
    : tile_(&tables.tile()),
      rest_seed_(plan.seed ^ kSalt),
      orders_(derive_key(pixel_key(~plan.seed ^ kSalt, {}), 0x6f72646572ull)),
      values_(derive_key(pixel_key(~plan.seed ^ kSalt, {}), 0x76616c756573ull)),
      moves_(derive_key(pixel_key(~plan.seed ^ kSalt, {}), 0x6d6f766573ull)) {}

}  // namespace koksma
