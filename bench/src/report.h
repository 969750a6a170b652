#pragma once
// summary.json and report.html from a folder's results.

#include <filesystem>
#include <string>

namespace koksma {

/// Writes summary.json from results.jsonl and prints its tables.
void write_summary(const std::filesystem::path& directory);

/// Makes report.html by the Python package under bench/report.
/// @return  false, with the reason, where Python or a package of it is missing: everything but the report works
[[nodiscard]] bool make_report(const std::filesystem::path& directory, std::string& why_not);

}  // namespace koksma
