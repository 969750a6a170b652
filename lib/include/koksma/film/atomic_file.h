#pragma once
// Files that appear whole or not at all.

#include <filesystem>
#include <functional>

namespace koksma {

/// Calls `write` with the path of a temporary file in the same folder, then renames it to `target`. Whatever is thrown or
/// fails on the way, no half-written file is left and an older `target` stays as it was.
/// @throws Error naming `target` and the reason
void write_atomically(const std::filesystem::path& target, const std::function<void(const std::filesystem::path&)>& write);

/// Throws at once, before any work is spent, if `target` could not be written. @throws Error
void require_writable(const std::filesystem::path& target);

}  // namespace koksma
