#include "files.h"

#include "fail.h"

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <memory>
#include <system_error>

namespace koksma::loader {

std::string read_file(const std::filesystem::path& file) {
    std::error_code error;
    if (std::filesystem::is_directory(file, error)) throw Error(file.string() + ": is a directory, not a file");
    struct Close {
        void operator()(std::FILE* f) const noexcept { std::fclose(f); }
    };
    const std::unique_ptr<std::FILE, Close> stream(std::fopen(file.string().c_str(), "rb"));
    if (!stream) throw Error(fmt::format("{}: cannot be opened: {}", file.string(), std::strerror(errno)));
    const auto size = std::filesystem::file_size(file, error);
    std::string bytes(error ? 0 : size, '\0');
    bytes.resize(std::fread(bytes.data(), 1, bytes.size(), stream.get()));
    for (char block[4096];;) {  // pipes and growing files: whatever is left
        const std::size_t n = std::fread(block, 1, sizeof block, stream.get());
        bytes.append(block, n);
        if (n < sizeof block) break;
    }
    if (std::ferror(stream.get())) throw Error(file.string() + ": reading failed");
    return bytes;
}

std::filesystem::path resolve(const std::string& name, const std::filesystem::path& scene_directory, const SourceLocation& where) {
    if (name.empty()) fail(where, "the file name is empty");
    const std::filesystem::path wanted(name);
    if (wanted.is_absolute()) {
        if (std::filesystem::exists(wanted)) return wanted;
        fail(where, "there is no file '{}'", name);
    }
    const std::filesystem::path beside = std::filesystem::path(where.file).parent_path() / wanted;
    if (std::filesystem::exists(beside)) return beside;
    const std::filesystem::path from_scene = scene_directory / wanted;
    if (std::filesystem::exists(from_scene)) return from_scene;
    if (beside == from_scene) fail(where, "there is no file '{}'; tried {}", name, beside.string());
    fail(where, "there is no file '{}'; tried {} and {}", name, beside.string(), from_scene.string());
}

}  // namespace koksma::loader
