#include "line_file.h"

#include <koksma/sampling/error.h>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

namespace koksma {

LineFile::LineFile(std::filesystem::path file, Mode mode)
    : file_(std::move(file)), descriptor_(::open(file_.c_str(), O_WRONLY | O_CREAT | (mode == Mode::empty ? O_TRUNC : 0) | O_APPEND | O_CLOEXEC, 0644)) {
    if (descriptor_ < 0) throw Error(fmt::format("cannot write {}: {}", file_.string(), std::strerror(errno)));
}

LineFile::~LineFile() { ::close(descriptor_); }

void LineFile::add(const nlohmann::ordered_json& json) {
    const std::string line = json.dump() + "\n";
    const off_t before = ::lseek(descriptor_, 0, SEEK_END);
    const ssize_t written = ::write(descriptor_, line.data(), line.size());
    if (written == static_cast<ssize_t>(line.size())) return;
    const int error = written < 0 ? errno : ENOSPC;
    if (::ftruncate(descriptor_, before) != 0) throw Error(fmt::format("cannot write {}, and its last line may be incomplete", file_.string()));
    throw Error(fmt::format("cannot write {}: {}; earlier rows are intact", file_.string(), std::strerror(error)));
}

}  // namespace koksma
