#include "progress.h"

#include <fmt/format.h>

#include <unistd.h>

#include <cmath>
#include <cstdio>

namespace koksma {

std::string duration_text(double seconds) {
    if (!(seconds < 1e9)) return "unknown";
    if (seconds < 10.0) return fmt::format("{:.1f} s", seconds);
    const auto s = static_cast<long long>(std::llround(seconds));
    if (s < 60) return fmt::format("{} s", s);
    if (s < 3600) return fmt::format("{} min {} s", s / 60, s % 60);
    return fmt::format("{} h {} min", s / 3600, s % 3600 / 60);
}

Progress::Progress(std::string title, bool enabled)
    : title_(std::move(title)), enabled_(enabled && ::isatty(STDERR_FILENO) != 0), start_(std::chrono::steady_clock::now()), last_(start_ - std::chrono::hours(1)) {}

Progress::~Progress() {
    if (enabled_) fmt::print(stderr, "\r\033[K");
}

void Progress::update(double fraction, const std::string& what) {
    if (!enabled_) return;
    const auto now = std::chrono::steady_clock::now();
    if (now - last_ < std::chrono::milliseconds(100) && fraction < 1.0) return;
    last_ = now;
    const double elapsed = std::chrono::duration<double>(now - start_).count();
    const int filled = static_cast<int>(fraction * 24.0);
    const std::string left = fraction > 0.01 ? duration_text(elapsed * (1.0 - fraction) / fraction) + " left" : "";
    fmt::print(stderr, "\r\033[K{} [{}{}] {:3.0f} %  {}  {}", title_, std::string(static_cast<std::size_t>(filled), '#'),
               std::string(static_cast<std::size_t>(24 - filled), '.'), 100.0 * fraction, left, what);
    std::fflush(stderr);
}

}  // namespace koksma
