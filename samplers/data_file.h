#pragma once
// Files that samplers read: their bytes, and a checksum that names their content.

#include <koksma/sampling/error.h>
#include <koksma/sampling/options.h>

#include <cstdint>
#include <string>
#include <string_view>

namespace koksma {

/// All bytes of a file.
/// @throws Error naming the file and the reason
[[nodiscard]] std::string read_data_file(const std::string& path);

/// 64 bits as 16 hexadecimal digits. Names a content; no protection against intent.
/// Source: FNV-1a, G. Fowler, L. C. Noll and K.-P. Vo (RFC 9923)
[[nodiscard]] std::string checksum_of(std::string_view bytes);

/// The value of a file option that stands for what the program brings along.
inline constexpr const char* kBuiltInFile = "built-in";

/// The declaration of the option `checksum`. A sampler with a file has it in its canonical name, so a result row names the
/// content and not only the place that it was read from; given with the file, another content is refused.
[[nodiscard]] inline OptionInfo checksum_option() {
    return {"checksum", "any", {}, "of the file's bytes; filled in when the file is read, and if given, another content is refused"};
}

/// @throws Error when the option `checksum` is given and there is no file
void check_no_checksum(const SamplerOptions& options);
/// @throws Error when the option `checksum` is given and is not the file's
void check_checksum(const SamplerOptions& options, const std::string& path, const std::string& checksum);

/// Splits text into lines; the line break ("\n" or "\r\n") is not part of a line.
class Lines {
public:
    explicit Lines(std::string_view text) noexcept : rest_(text) {}
    /// Whether there was another line.
    [[nodiscard]] bool next(std::string_view& line) noexcept;
    [[nodiscard]] int number() const noexcept { return number_; }

private:
    std::string_view rest_;
    int number_ = 0;
};

/// The next run of characters without blanks, commas and tabs, removed from `line`; empty at its end.
[[nodiscard]] std::string_view next_word(std::string_view& line) noexcept;

}  // namespace koksma
