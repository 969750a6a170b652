#pragma once
// Rows of earlier runs in the same folder: what an interrupted or repeated run need not render again.

#include "line_file.h"
#include "row.h"

#include <filesystem>
#include <map>
#include <memory>
#include <string>

namespace koksma {

/// What a row answers: two rows of one key differ in nothing but time. The sampler counts by its own version, not by the program's commit.
[[nodiscard]] std::string key_of(const Row& row);

/// How many rows of this program's format a folder holds.
[[nodiscard]] std::size_t count_rows(const std::filesystem::path& folder);

/// results.jsonl and, where a run was interrupted, results.partial.jsonl beside it.
class RowStore {
public:
    /// Reads both. A last half line of the partial file, which only a crash of the machine can leave, is cut off.
    /// @param fresh  begin with nothing
    /// @throws Error naming a file that holds something else
    RowStore(const std::filesystem::path& folder, bool fresh);

    /// nullptr where there is none.
    [[nodiscard]] const nlohmann::ordered_json* find(const std::string& key) const;
    /// Of the rows that were there at the start.
    [[nodiscard]] std::size_t size() const noexcept { return rows_.size(); }
    [[nodiscard]] std::size_t interrupted() const noexcept { return interrupted_; }

    /// Appends to the partial file.
    void add(const Row& row);
    [[nodiscard]] std::size_t added() const noexcept { return added_; }
    [[nodiscard]] const std::filesystem::path& partial_file() const noexcept { return partial_; }

    /// All rows are in results.jsonl now.
    void finish();
    /// The run failed. @return rows that the partial file keeps; where there are none, there is no file
    std::size_t give_up() noexcept;

private:
    std::filesystem::path partial_;
    std::map<std::string, nlohmann::ordered_json> rows_;
    std::unique_ptr<LineFile> out_;
    std::size_t interrupted_ = 0, added_ = 0;
};

}  // namespace koksma
