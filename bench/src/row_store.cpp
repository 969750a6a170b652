#include "row_store.h"

#include "json_error.h"

#include <koksma/sampling/error.h>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include <fstream>
#include <sstream>

namespace koksma {

namespace {

using Json = nlohmann::ordered_json;

std::string text_of_file(const std::filesystem::path& file) {
    std::ifstream in(file, std::ios::binary);
    std::ostringstream out;
    out << in.rdbuf();
    return out.str();
}

/// Reads the rows of a file; with `cut`, shortens it to its whole lines. @return how many
std::size_t read_rows(const std::filesystem::path& file, bool cut, std::map<std::string, Json>& rows) {
    if (!std::filesystem::exists(file)) return 0;
    std::string text = text_of_file(file);
    if (!text.empty() && !text.ends_with('\n')) {
        text.resize(text.find_last_of('\n') + 1);  // npos + 1 is 0
        if (cut) std::filesystem::resize_file(file, text.size());
    }
    std::istringstream lines(text);
    std::size_t number = 0, count = 0;
    for (std::string line; std::getline(lines, line);) {
        ++number;
        try {
            Json json = Json::parse(line);
            if (json.at("kind") != "render") continue;
            if (json.value("row_format", 1) != kRowFormat) continue;  // of an older program: rendered again
            const Row row = json.get<Row>();
            rows[key_of(row)] = std::move(json);
            ++count;
        } catch (const Json::exception& e) {
            throw Error(fmt::format("{}:{}: not a row of results: {}; give another folder with --out, or --fresh to begin again", file.string(), number, text_of(e)));
        }
    }
    return count;
}

}  // namespace

std::string key_of(const Row& r) {
    const std::string prefix = r.prefix_of > 0 ? fmt::format(" prefix of {}", r.prefix_of) : "";
    return fmt::format("{} {} crop {} film {} depth {} {} {} v{} dims {} spp {} r{} l{} seed {:x} est {} ref {} {} threads {} on {} {}{}",
                       r.scene, r.scene_hash, fmt::join(r.crop, ","), fmt::join(r.film, "x"), r.max_depth, r.rr_depth, r.sampler,
                       r.sampler_version, r.dimensions, r.spp, r.replicate, r.layout, r.seed, r.estimator_version, r.reference,
                       r.reference_content, r.threads, r.machine, r.isa, prefix);
}

std::size_t count_rows(const std::filesystem::path& folder) {
    std::map<std::string, Json> rows;
    static_cast<void>(read_rows(folder / "results.jsonl", false, rows));
    static_cast<void>(read_rows(folder / "results.partial.jsonl", false, rows));
    return rows.size();
}

RowStore::RowStore(const std::filesystem::path& folder, bool fresh) : partial_(folder / "results.partial.jsonl") {
    if (fresh) {
        std::error_code none;
        std::filesystem::remove(partial_, none);
    } else {
        static_cast<void>(read_rows(folder / "results.jsonl", false, rows_));
        interrupted_ = read_rows(partial_, true, rows_);
    }
    out_ = std::make_unique<LineFile>(partial_, LineFile::Mode::append);
}

const Json* RowStore::find(const std::string& key) const {
    const auto it = rows_.find(key);
    return it == rows_.end() ? nullptr : &it->second;
}

void RowStore::add(const Row& row) {
    out_->add(row);
    ++added_;
}

void RowStore::finish() {
    out_.reset();
    std::error_code none;
    std::filesystem::remove(partial_, none);
}

std::size_t RowStore::give_up() noexcept {
    out_.reset();
    const std::size_t kept = interrupted_ + added_;
    std::error_code none;
    if (kept == 0) std::filesystem::remove(partial_, none);
    return kept;
}

}  // namespace koksma
