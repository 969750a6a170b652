#pragma once
// A file of lines that never holds half of one.

#include <nlohmann/json_fwd.hpp>

#include <filesystem>

namespace koksma {

/// Starts a file, empty or with what it holds, and appends JSON objects, a line each, each by one write. A line that does not fit on the disk is
/// taken back.
class LineFile {
public:
    enum class Mode { empty, append };
    /// @throws Error naming the file and the reason
    explicit LineFile(std::filesystem::path file, Mode mode = Mode::empty);
    ~LineFile();
    LineFile(const LineFile&) = delete;
    LineFile& operator=(const LineFile&) = delete;
    /// @throws Error; what was written before is intact
    void add(const nlohmann::ordered_json& json);

private:
    std::filesystem::path file_;
    int descriptor_;
};

}  // namespace koksma
