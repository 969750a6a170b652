#include "npy.h"

#include <koksma/sampling/error.h>

#include <bit>
#include <charconv>
#include <cstdint>
#include <cstring>

namespace koksma {
namespace {

constexpr std::string_view kMagic = "\x93NUMPY";

/// The header is the text of a Python dictionary with the keys descr, fortran_order and shape, in any order.
class Header {
public:
    Header(std::string_view text, const std::string& file) : text_(text), file_(file) {}

    std::string_view descr{}, order{};
    std::vector<std::size_t> shape{};

    void parse() {
        bool has_shape = false;
        expect('{');
        while (!accept('}')) {
            const std::string_view key = quoted();
            expect(':');
            if (key == "descr") {
                blanks();
                if (text_.empty() || (text_.front() != '\'' && text_.front() != '"')) fail("has structured elements; plain float32 or float64 are read");
                descr = quoted();
            } else if (key == "fortran_order") {
                blanks();
                order = text_.substr(0, text_.find_first_of(",} \n"));
                text_.remove_prefix(order.size());
            } else if (key == "shape") {
                tuple();
                has_shape = true;
            } else {
                fail("has the key '" + std::string(key) + "' in its header; descr, fortran_order and shape are known");
            }
            if (!accept(',')) {
                expect('}');
                break;
            }
        }
        if (descr.empty() || order.empty() || !has_shape) fail("has a header without descr, fortran_order or shape");
    }
    [[noreturn]] void fail(const std::string& what) const { throw Error(file_ + ": " + what); }

private:
    void blanks() {
        while (!text_.empty() && (text_.front() == ' ' || text_.front() == '\n')) text_.remove_prefix(1);
    }
    bool accept(char c) {
        blanks();
        if (text_.empty() || text_.front() != c) return false;
        text_.remove_prefix(1);
        return true;
    }
    void expect(char c) {
        if (!accept(c)) fail(std::string("has a header that is not understood: '") + c + "' is missing before '" + std::string(text_.substr(0, 20)) + "'");
    }
    std::string_view quoted() {
        blanks();
        const char quote = text_.empty() ? '\'' : text_.front();
        const auto end = text_.find(quote, 1);
        if ((quote != '\'' && quote != '"') || end == std::string_view::npos) expect('\'');
        const std::string_view word = text_.substr(1, end - 1);
        text_.remove_prefix(end + 1);
        return word;
    }
    void tuple() {
        expect('(');
        while (!accept(')')) {
            blanks();
            std::size_t n = 0;
            const auto [end, error] = std::from_chars(text_.data(), text_.data() + text_.size(), n);
            if (error != std::errc{}) fail("has a shape that is not a tuple of sizes");
            text_.remove_prefix(static_cast<std::size_t>(end - text_.data()));
            shape.push_back(n);
            if (!accept(',')) {
                expect(')');
                break;
            }
        }
    }
    std::string_view text_;
    const std::string& file_;
};

/// Little-endian bytes, whatever the machine.
std::uint64_t little(std::string_view bytes) noexcept {
    std::uint64_t n = 0;
    for (std::size_t i = bytes.size(); i-- > 0;) n = (n << 8) | static_cast<unsigned char>(bytes[i]);
    return n;
}

std::string text_of(const std::vector<std::size_t>& shape) {
    std::string text = "(";
    for (const std::size_t n : shape) text += (text.size() > 1 ? ", " : "") + std::to_string(n);
    return text + ")";
}

}  // namespace

bool is_npy(std::string_view bytes) noexcept { return bytes.starts_with(kMagic); }

NpyArray parse_npy(std::string_view bytes, const std::string& file) {
    if (!is_npy(bytes) || bytes.size() < 10) throw Error(file + ": is not an .npy file: it does not begin as one");
    const auto version = static_cast<unsigned char>(bytes[6]);
    if (version < 1 || version > 3) throw Error(file + ": is of .npy version " + std::to_string(version) + "; 1, 2 and 3 are read");
    const std::size_t start = version == 1 ? 10 : 12;
    if (bytes.size() < start) throw Error(file + ": ends within its header");
    const std::size_t length = little(bytes.substr(8, start - 8));
    if (length > bytes.size() - start) throw Error(file + ": ends within its header");
    Header header(bytes.substr(start, length), file);
    header.parse();
    if (header.descr != "<f4" && header.descr != "<f8")
        header.fail("has elements of type '" + std::string(header.descr) + "'; '<f4' and '<f8' (little-endian float32, float64) are read");
    if (header.order != "False")
        header.fail("is in Fortran order (fortran_order is " + std::string(header.order) + "); save it with numpy.ascontiguousarray");
    const std::size_t size = header.descr == "<f4" ? 4 : 8, data = start + length;
    std::size_t count = 1;
    for (const std::size_t n : header.shape) {
        if (n == 0) header.fail("is empty: its shape is " + text_of(header.shape));
        if (count > bytes.size() / n) header.fail("ends too early: the shape " + text_of(header.shape) + " is larger than the file");
        count *= n;
    }
    if (bytes.size() - data != count * size)
        header.fail("has " + std::to_string(bytes.size() - data) + " bytes of data; the shape " + text_of(header.shape) + " needs " + std::to_string(count * size));
    NpyArray array{header.shape, std::vector<double>(count)};
    for (std::size_t i = 0; i < count; ++i) {
        const std::uint64_t word = little(bytes.substr(data + i * size, size));
        array.values[i] = size == 8 ? std::bit_cast<double>(word) : static_cast<double>(std::bit_cast<float>(static_cast<std::uint32_t>(word)));
    }
    return array;
}

}  // namespace koksma
