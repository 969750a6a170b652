#include "header_comment.h"

#include "numbers.h"

namespace koksma::loader {
namespace {

/// The length of "word:" at the start of a line, or 0.
std::size_t key_length(std::string_view line) {
    std::size_t n = 0;
    while (n < line.size() && ((line[n] >= 'a' && line[n] <= 'z') || line[n] == '_')) ++n;
    return n > 0 && n < line.size() && line[n] == ':' && (n + 1 == line.size() || line[n + 1] == ' ') ? n + 1 : 0;
}

}  // namespace

void read_header_comment(std::string_view comment, SceneDescription& scene) {
    std::string* current = nullptr;
    while (!comment.empty()) {
        const auto end = comment.find('\n');
        std::string_view line = trimmed(comment.substr(0, end));
        comment.remove_prefix(end == std::string_view::npos ? comment.size() : end + 1);
        if (const std::size_t n = key_length(line)) {
            const std::string_view key = line.substr(0, n);
            current = key == "purpose:" ? &scene.purpose : key == "expect:" ? &scene.expect : nullptr;
            line = trimmed(line.substr(n));
        }
        if (!current || line.empty()) continue;
        if (!current->empty()) *current += ' ';
        *current += line;
    }
}

}  // namespace koksma::loader
