#include "files.h"

#include "fail.h"

#include <algorithm>
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

std::filesystem::path resolve(const std::string& name, const SearchPath& search, const SourceLocation& where) {
    if (name.empty()) fail(where, "the file name is empty");
    const std::filesystem::path wanted(name);
    std::error_code ignored;
    if (wanted.is_absolute()) {
        if (std::filesystem::exists(wanted, ignored)) return wanted;
        fail(where, "there is no file '{}'", name);
    }
    SearchPath folders = search;
    folders.insert(folders.empty() ? folders.end() : folders.end() - 1, std::filesystem::path(where.file).parent_path());
    std::vector<std::string> tried;
    for (const auto& folder : folders) {
        std::filesystem::path file = folder / wanted;
        if (std::filesystem::exists(file, ignored)) return file;
        if (std::find(tried.begin(), tried.end(), file.string()) == tried.end()) tried.push_back(file.string());
    }
    fail(where, "there is no file '{}'; tried {}", name, list_of(tried));
}

}  // namespace koksma::loader
