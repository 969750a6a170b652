#include "image_claims.h"

#include <koksma/sampling/error.h>

#include <string_view>

namespace koksma::loader {
namespace {

constexpr std::string_view kPng{"\x89PNG\r\n\x1a\n", 8};

bool starts_with(const std::string& bytes, std::string_view what) { return std::string_view(bytes).substr(0, what.size()) == what; }

/// Pixels that a byte of the file can stand for, at most.
std::int64_t densest(const std::string& bytes) {
    if (starts_with(bytes, kPng)) return 1032 * 8;  // deflate's longest match for two bits; a bit a pixel
    if (starts_with(bytes, "#?")) return 16;        // runs of 127 in two bytes, for each of four channels
    return 8 * 64;                                  // JPEG: a bit for a block of 64
}

/// Source: PNG specification (ISO/IEC 15948), section 5.3: length, type, data, checksum.
void check_chunks(const std::string& bytes, const std::string& name) {
    const auto byte = [&](std::size_t i) { return std::uint64_t{static_cast<unsigned char>(bytes[i])}; };
    for (std::size_t at = kPng.size(); at + 8 <= bytes.size();) {
        const std::uint64_t length = byte(at) << 24 | byte(at + 1) << 16 | byte(at + 2) << 8 | byte(at + 3), left = bytes.size() - at - 8;
        if (length > left)
            throw Error(name + ": the PNG chunk at byte " + std::to_string(at) + " has " + std::to_string(length) + " bytes of data, but the file ends after " +
                        std::to_string(left));
        if (std::string_view(bytes).substr(at + 4, 4) == "IEND") return;
        at += 12 + length;
    }
}

}  // namespace

void check_claims(const std::string& bytes, std::int64_t width, std::int64_t height, const std::string& name) {
    const auto size = static_cast<std::int64_t>(bytes.size());
    if (width > 0 && height > densest(bytes) * size / width)
        throw Error(name + ": " + std::to_string(size) + " bytes cannot hold the " + std::to_string(width) + " x " + std::to_string(height) + " pixels that it claims");
    if (starts_with(bytes, kPng)) check_chunks(bytes, name);
}

}  // namespace koksma::loader
