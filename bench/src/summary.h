#pragma once
// From rows to what a report says: all statistics, as JSON. Nothing downstream computes another number.

#include "row.h"

#include <nlohmann/json_fwd.hpp>

#include <filesystem>
#include <vector>

namespace koksma {


/// @param header  the experiment's line: name, targets, scenes with their pictures and references
/// @param rows    in any order
[[nodiscard]] nlohmann::ordered_json summarize(const nlohmann::ordered_json& header, const std::vector<Row>& rows);

/// Reads a results.jsonl: the header line, then rows. @throws Error with the line number
void read_results(const std::filesystem::path& file, nlohmann::ordered_json& header, std::vector<Row>& rows);

/// Prints the tables of a summary to stdout.
void print_tables(const nlohmann::ordered_json& summary);

}  // namespace koksma
