#include "data_file.h"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <iterator>

namespace koksma {

std::string read_data_file(const std::string& path) {
    std::ifstream file(path, std::ios::binary);
    if (!file) throw Error(path + ": cannot be opened: " + std::strerror(errno));
    std::string bytes(std::istreambuf_iterator<char>(file), {});
    if (file.bad() || bytes.empty()) throw Error(path + ": " + (file.bad() ? "cannot be read" : "the file is empty"));
    return bytes;
}

std::string checksum_of(std::string_view bytes) {
    std::uint64_t h = 0xcbf29ce484222325ull;
    for (const char c : bytes) h = (h ^ static_cast<unsigned char>(c)) * 0x100000001b3ull;
    std::string text(16, '0');
    for (std::size_t i = 0; i < 16; ++i) text[i] = "0123456789abcdef"[(h >> (60 - 4 * i)) & 15u];
    return text;
}

void check_no_checksum(const SamplerOptions& options) {
    if (options["checksum"] != "any") throw Error("sampler '" + options.canonical() + "': checksum= is given, but no file");
}

void check_checksum(const SamplerOptions& options, const std::string& path, const std::string& checksum) {
    if (const std::string& wanted = options["checksum"]; wanted != "any" && wanted != checksum)
        throw Error(path + ": its content has the checksum " + checksum + "; checksum=" + wanted + " was asked for");
}

bool Lines::next(std::string_view& line) noexcept {
    if (rest_.empty()) return false;
    const auto end = rest_.find('\n');
    line = rest_.substr(0, end);
    rest_ = end == std::string_view::npos ? std::string_view{} : rest_.substr(end + 1);
    if (!line.empty() && line.back() == '\r') line.remove_suffix(1);
    ++number_;
    return true;
}

std::string_view next_word(std::string_view& line) noexcept {
    constexpr std::string_view kBlanks = " \t,";
    line.remove_prefix(std::min(line.find_first_not_of(kBlanks), line.size()));
    const std::string_view word = line.substr(0, line.find_first_of(kBlanks));
    line.remove_prefix(word.size());
    return word;
}

}  // namespace koksma
