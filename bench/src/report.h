#pragma once
// summary.json and report.html from a folder's results.

#include <nlohmann/json_fwd.hpp>

#include <filesystem>
#include <string>
#include <vector>

namespace koksma {

/// Writes summary.json from results.jsonl and prints its tables.
void write_summary(const std::filesystem::path& directory);

/// Writes results.jsonl, whole or not at all.
void write_results(const std::filesystem::path& directory, const nlohmann::ordered_json& header, const std::vector<nlohmann::ordered_json>& rows);

/// Summary, tables and, unless it is not wanted, the report of a folder whose rows are complete. @return 0
/// @throws Error where the report cannot be made
int finish_results(const std::filesystem::path& directory, bool no_report);

/// Makes report.html by the Python package under bench/report.
/// @param more  further arguments of `python -m report`
/// @return      false, with the reason, where Python or a package of it is missing: everything but the report works
[[nodiscard]] bool make_report(const std::filesystem::path& directory, std::string& why_not, const std::vector<std::string>& more = {});

}  // namespace koksma
