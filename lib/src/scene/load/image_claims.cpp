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

/// Codes of all Huffman tables: stb_image 2.27 writes them into arrays of 257 without counting.
/// Source: ITU-T T.81, sections B.1.1 (markers) and B.2.4.2 (tables: class and place, 16 counts, values).
void check_huffman_tables(const std::string& bytes, const std::string& name) {
    const auto byte = [&](std::size_t i) { return i < bytes.size() ? std::size_t{static_cast<unsigned char>(bytes[i])} : 0; };
    for (std::size_t at = 2; at + 3 < bytes.size();) {
        const std::size_t marker = byte(at + 1);
        if (byte(at) != 0xff || marker == 0xff) {  // coded data, or fill bytes
            ++at;
            continue;
        }
        at += 2;
        if (marker <= 0x01 || (marker >= 0xd0 && marker <= 0xd9)) continue;  // a stuffed byte, and markers without a segment
        const std::size_t end = at + (byte(at) << 8 | byte(at + 1));
        if (marker == 0xc4)
            for (std::size_t table = at + 2; table < end;) {
                std::size_t codes = 0;
                for (std::size_t i = 1; i <= 16; ++i) codes += byte(table + i);
                if (codes > 256)
                    throw Error(name + ": the Huffman table at byte " + std::to_string(table) + " has " + std::to_string(codes) + " codes; expected at most 256");
                table += 17 + codes;
            }
        if (marker != 0xda) at = end;
    }
}

}  // namespace

void check_claims(const std::string& bytes, const std::string& name) {
    if (starts_with(bytes, kPng)) check_chunks(bytes, name);
    if (starts_with(bytes, "\xff\xd8")) check_huffman_tables(bytes, name);
}

void check_size(const std::string& bytes, std::int64_t width, std::int64_t height, const std::string& name) {
    const auto size = static_cast<std::int64_t>(bytes.size());
    if (width > 0 && height > densest(bytes) * size / width)
        throw Error(name + ": " + std::to_string(size) + " bytes cannot hold the " + std::to_string(width) + " x " + std::to_string(height) + " pixels that it claims");
}

}  // namespace koksma::loader
