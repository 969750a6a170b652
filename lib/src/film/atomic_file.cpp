#include <koksma/film/atomic_file.h>
#include <koksma/sampling/error.h>

#include <fmt/format.h>

#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <fstream>
#include <system_error>

namespace koksma {

namespace {

std::filesystem::path temporary_beside(const std::filesystem::path& target) {
    std::filesystem::path temporary = target;
    temporary += fmt::format(".tmp{}", ::getpid());
    return temporary;
}

}  // namespace

void write_atomically(const std::filesystem::path& target, const std::function<void(const std::filesystem::path&)>& write) {
    const std::filesystem::path temporary = temporary_beside(target);
    try {
        write(temporary);
        std::filesystem::rename(temporary, target);
    } catch (const std::exception& e) {
        std::error_code ignored;
        std::filesystem::remove(temporary, ignored);
        throw Error(fmt::format("cannot write {}: {}", target.string(), e.what()));
    }
}

void require_writable(const std::filesystem::path& target) {
    if (std::filesystem::is_directory(target)) throw Error(fmt::format("cannot write {}: it is a folder; give a file name", target.string()));
    const std::filesystem::path temporary = temporary_beside(target);
    errno = 0;
    {
        const std::ofstream probe(temporary);
        if (!probe)
            throw Error(fmt::format("cannot write {}: {}; choose a folder that exists and is writable", target.string(), std::strerror(errno)));
    }
    std::error_code ignored;
    std::filesystem::remove(temporary, ignored);
}

}  // namespace koksma
