#pragma once
// A progress line with the time left, on stderr, only where someone looks.

#include <chrono>
#include <string>

namespace koksma {

class Progress {
public:
    /// @param enabled  also needs stderr to be a terminal
    Progress(std::string title, bool enabled);
    ~Progress();
    Progress(const Progress&) = delete;
    Progress& operator=(const Progress&) = delete;
    /// @param fraction  of the work done, [0, 1]
    void update(double fraction, const std::string& what = {});

private:
    std::string title_;
    bool enabled_;
    std::chrono::steady_clock::time_point start_, last_;
};

/// "1 min 20 s"
[[nodiscard]] std::string duration_text(double seconds);

}  // namespace koksma
