#include "fail.h"

#include <algorithm>
#include <cstddef>
#include <vector>

namespace koksma {

std::string SourceLocation::text() const {
    const std::string name = file.empty() ? "<unknown>" : file;
    if (line <= 0) return name;
    if (column <= 0) return fmt::format("{}:{}", name, line);
    return fmt::format("{}:{}:{}", name, line, column);
}

namespace loader {

std::string list_of(std::span<const std::string> names) {
    if (names.empty()) return "none";
    std::string text;
    for (const std::string& name : names) text += (text.empty() ? "" : ", ") + name;
    return text;
}

namespace {
// Levenshtein 1966, one row at a time.
std::size_t edit_distance(std::string_view a, std::string_view b) {
    std::vector<std::size_t> row(b.size() + 1);
    for (std::size_t j = 0; j <= b.size(); ++j) row[j] = j;
    for (std::size_t i = 1; i <= a.size(); ++i) {
        std::size_t diagonal = row[0];
        row[0] = i;
        for (std::size_t j = 1; j <= b.size(); ++j) {
            const std::size_t substituted = diagonal + (a[i - 1] == b[j - 1] ? 0 : 1);
            diagonal = row[j];
            row[j] = std::min({row[j] + 1, row[j - 1] + 1, substituted});
        }
    }
    return row[b.size()];
}
}  // namespace

std::string did_you_mean(std::string_view wanted, std::span<const std::string> names) {
    const std::string* best = nullptr;
    // A third of the letters may be wrong, and two (a swap) in all but the shortest names.
    std::size_t best_distance = 1 + (wanted.size() <= 3 ? 1 : std::max<std::size_t>(2, wanted.size() / 3));
    for (const std::string& name : names) {
        const std::size_t d = edit_distance(wanted, name);
        if (d < best_distance) best = &name, best_distance = d;
    }
    return best ? fmt::format("did you mean '{}'? ", *best) : std::string{};
}

}  // namespace loader
}  // namespace koksma
