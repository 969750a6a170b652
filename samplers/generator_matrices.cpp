#include "generator_matrices.h"

#include "data_file.h"
#include "primes.h"

#include <algorithm>
#include <charconv>
#include <limits>

namespace koksma {
namespace {

constexpr std::uint64_t kMostEntries = std::uint64_t{1} << 28;

class Parser {
public:
    Parser(std::string_view text, const std::string& file) : lines_(text), file_(file) {}

    GeneratorMatrices run() {
        if (!next_line() || next_word(line_) != "koksma-matrices" || number("the version") != 1) fail("expected 'koksma-matrices 1'");
        nothing_more();
        header();
        for (std::uint32_t d = 0; d < m_.dimensions; ++d) matrix(d);
        if (next_line()) fail("expected the end of the file after " + std::to_string(m_.dimensions) + " matrices");
        return std::move(m_);
    }

private:
    [[noreturn]] void fail(const std::string& what) const { throw Error(file_ + ":" + std::to_string(lines_.number()) + ": " + what); }

    /// The next line that is not blank after its comment is removed.
    bool next_line() {
        while (lines_.next(line_)) {
            line_ = line_.substr(0, line_.find('#'));
            if (line_.find_first_not_of(" \t,") != std::string_view::npos) return true;
        }
        return false;
    }
    std::uint32_t number(const std::string& what) {
        const std::string_view word = next_word(line_);
        std::uint32_t n = 0;
        const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), n);
        if (word.empty() || error != std::errc{} || end != word.data() + word.size())
            fail(word.empty() ? "expected " + what : "'" + std::string(word) + "' is not a whole number; expected " + what);
        return n;
    }
    void nothing_more() {
        if (const std::string_view word = next_word(line_); !word.empty()) fail("'" + std::string(word) + "' was not expected here");
    }

    void header() {
        struct Field {
            std::string_view name;
            std::uint32_t* value;
            bool given = false;
        } fields[] = {{"base", &m_.base}, {"dimensions", &m_.dimensions}, {"rows", &m_.rows}, {"columns", &m_.columns}};
        for (int left = 4; left > 0; --left) {
            if (!next_line()) fail("the file ends before base, dimensions, rows and columns are given");
            const std::string_view name = next_word(line_);
            const auto field = std::find_if(std::begin(fields), std::end(fields), [&](const Field& f) { return f.name == name; });
            if (field == std::end(fields)) fail("'" + std::string(name) + "' is not one of base, dimensions, rows, columns");
            if (field->given) fail("'" + std::string(name) + "' is given twice");
            field->given = true;
            *field->value = number("a number after '" + std::string(name) + "'");
            nothing_more();
            if (name == "base" && !std::binary_search(kPrimes.begin(), kPrimes.end(), m_.base))
                fail("base " + std::to_string(m_.base) + " is not a prime up to " + std::to_string(kPrimes.back()));
            if (*field->value == 0) fail(std::string(name) + " is 0");
        }
        if (m_.rows < m_.columns)
            fail(std::to_string(m_.rows) + " rows and " + std::to_string(m_.columns) + " columns: with fewer rows than columns values would repeat");
        if (m_.columns > 64 || std::uint64_t{m_.rows} * m_.columns * m_.dimensions > kMostEntries)
            fail("at most 64 columns and 2^28 entries are possible; this would have " + std::to_string(m_.columns) + " and " + std::to_string(m_.dimensions) + " x " +
                 std::to_string(m_.rows) + " x " + std::to_string(m_.columns));
        m_.entries.reserve(std::size_t{m_.rows} * m_.columns * m_.dimensions);
    }

    void matrix(std::uint32_t d) {
        const std::string name = "matrix " + std::to_string(d);
        if (!next_line()) fail("the file ends before " + name + " of " + std::to_string(m_.dimensions));
        if (next_word(line_) != "matrix" || number("the number of the matrix") != d) fail("expected '" + name + "'");
        nothing_more();
        const int first_line = lines_.number();
        for (std::uint32_t r = 0; r < m_.rows; ++r) {
            if (!next_line()) fail("the file ends in " + name + ", which has " + std::to_string(r) + " of " + std::to_string(m_.rows) + " rows");
            std::uint32_t c = 0;
            for (std::string_view rest = line_; !next_word(rest).empty();) ++c;
            if (c != m_.columns)
                fail("row " + std::to_string(r) + " of " + name + " has " + std::to_string(c) + " entries; there are " + std::to_string(m_.columns) + " columns");
            for (c = 0; c < m_.columns; ++c) {
                const std::uint32_t entry = number("an entry");
                if (entry >= m_.base)
                    fail("row " + std::to_string(r) + " of " + name + ": the entry " + std::to_string(entry) + " is not a digit in base " + std::to_string(m_.base));
                m_.entries.push_back(static_cast<std::uint16_t>(entry));
            }
        }
        check_regular(d, name, first_line);
    }

    std::uint32_t inverse(std::uint32_t n) const noexcept {  // n^(base - 2), Fermat
        std::uint32_t result = 1;
        for (std::uint32_t e = m_.base - 2; e != 0; e >>= 1, n = n * n % m_.base)
            if (e & 1u) result = result * n % m_.base;
        return result;
    }

    /// Elimination: columns of rank below `columns` are refused; a zero pivot in place ends the promise of strata.
    void check_regular(std::uint32_t d, const std::string& name, int first_line) {
        const std::size_t columns = m_.columns;
        std::vector<std::uint32_t> a(std::size_t{m_.rows} * columns);
        for (std::size_t r = 0; r < m_.rows; ++r)
            for (std::size_t c = 0; c < columns; ++c) a[r * columns + c] = m_.entry(d, r, c);
        for (std::size_t c = 0; c < columns; ++c) {
            std::size_t pivot = c;
            while (pivot < m_.rows && a[pivot * columns + c] == 0) ++pivot;
            if (pivot == m_.rows)
                throw Error(file_ + ":" + std::to_string(first_line) + ": " + name + " is singular: column " + std::to_string(c) +
                            " is a combination of those before it, so values would repeat");
            if (pivot != c) {
                m_.stratified = false;
                std::swap_ranges(a.begin() + static_cast<std::ptrdiff_t>(c * columns), a.begin() + static_cast<std::ptrdiff_t>((c + 1) * columns),
                                 a.begin() + static_cast<std::ptrdiff_t>(pivot * columns));
            }
            const std::uint32_t factor = inverse(a[c * columns + c]);
            for (std::size_t r = c + 1; r < m_.rows; ++r) {
                const std::uint32_t times = a[r * columns + c] * factor % m_.base;
                if (times == 0) continue;
                for (std::size_t k = c; k < columns; ++k) a[r * columns + k] = (a[r * columns + k] + (m_.base - times) * a[c * columns + k]) % m_.base;
            }
        }
    }

    Lines lines_;
    const std::string& file_;
    std::string_view line_{};
    GeneratorMatrices m_{};
};

}  // namespace

std::uint64_t GeneratorMatrices::point_count() const noexcept {
    std::uint64_t n = 1;
    for (std::uint32_t c = 0; c < columns; ++c) {
        if (n > std::numeric_limits<std::uint64_t>::max() / base) return std::numeric_limits<std::uint64_t>::max();
        n *= base;
    }
    return n;
}

GeneratorMatrices GeneratorMatrices::parse(std::string_view text, const std::string& file) { return Parser(text, file).run(); }

}  // namespace koksma
