#include "numpy_file.h"

#include <koksma/film/atomic_file.h>
#include <koksma/sampling/error.h>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <bit>
#include <fstream>

namespace koksma {

static_assert(std::endian::native == std::endian::little, "values are written as they lie in memory");

std::string npy_header(const std::vector<std::uint64_t>& shape) {
    std::string text = fmt::format("{{'descr': '<f4', 'fortran_order': False, 'shape': ({}), }}", fmt::join(shape, ", "));
    text.append(64 - (10 + text.size() + 1) % 64, ' ');
    text += '\n';
    const auto size = static_cast<unsigned>(text.size());
    return std::string("\x93NUMPY\x01\x00", 8) + static_cast<char>(size & 255u) + static_cast<char>(size >> 8) + text;
}

void write_npy(const std::filesystem::path& file, std::span<const float> values, const std::vector<std::uint64_t>& shape) {
    write_atomically(file, [&](const std::filesystem::path& path) {
        std::ofstream out(path, std::ios::binary);
        out << npy_header(shape);
        out.write(reinterpret_cast<const char*>(values.data()), static_cast<std::streamsize>(values.size_bytes()));
        out.flush();
        if (!out) throw Error("the disk is full or the folder is not writable");
    });
}

}  // namespace koksma
