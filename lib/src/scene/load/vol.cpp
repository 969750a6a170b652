// Mitsuba's .vol files, version 3: a header of 48 bytes, then floats.

#include "fail.h"
#include "files.h"

#include <koksma/scene/load.h>

#include <bit>
#include <cmath>
#include <cstring>

namespace koksma {

namespace {

static_assert(std::endian::native == std::endian::little, "the format is little endian, and read as it lies");

struct Header {
    char magic[3];
    std::uint8_t version;
    std::int32_t encoding, size[3], channels;
    float low[3], high[3];
};
static_assert(sizeof(Header) == 48);

}  // namespace

VolumeGrid load_vol(const std::filesystem::path& file) {
    const std::string bytes = loader::read_file(file);
    const auto bad = [&](const std::string& what) -> Error { return Error(file.string() + ": " + what); };
    Header h;
    if (bytes.size() < sizeof h) throw bad("too short for a volume: " + std::to_string(bytes.size()) + " bytes");
    std::memcpy(&h, bytes.data(), sizeof h);
    if (std::memcmp(h.magic, "VOL", 3) != 0) throw bad("not a volume: it must begin with VOL");
    if (h.version != 3) throw bad(fmt::format("volume version {} is not supported; supported: 3", h.version));
    if (h.encoding != 1) throw bad(fmt::format("volume encoding {} is not supported; supported: 1 (32-bit floats)", h.encoding));
    if (h.channels != 1 && h.channels != 3) throw bad(fmt::format("a volume of {} channels is not supported; supported: 1, 3", h.channels));
    std::uint64_t floats = static_cast<std::uint64_t>(h.channels);
    for (const std::int32_t n : h.size) {
        if (n < 1) throw bad(fmt::format("a volume of {} x {} x {} cells", h.size[0], h.size[1], h.size[2]));
        floats *= static_cast<std::uint64_t>(n);
        if (floats > bytes.size()) break;  // the product of three would overflow
    }
    if (floats > bytes.size() || bytes.size() - sizeof h != 4 * floats)
        throw bad(fmt::format("{} x {} x {} cells of {} channels do not fit the file's {} bytes", h.size[0], h.size[1], h.size[2],
                              h.channels, bytes.size()));
    VolumeGrid grid;
    grid.size = {h.size[0], h.size[1], h.size[2]};
    grid.channels = h.channels;
    grid.low = {h.low[0], h.low[1], h.low[2]};
    grid.high = {h.high[0], h.high[1], h.high[2]};
    grid.values.resize(static_cast<std::size_t>(floats));
    std::memcpy(grid.values.data(), bytes.data() + sizeof h, static_cast<std::size_t>(4 * floats));
    for (std::size_t i = 0; i < grid.values.size(); ++i)
        if (!std::isfinite(grid.values[i])) throw bad(fmt::format("value {} is {}; it must be finite", i, grid.values[i]));
    return grid;
}

}  // namespace koksma
