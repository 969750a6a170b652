#include "curve.h"
#include "lecture/topics.h"
#include "machine.h"
#include "page.h"
#include "progress.h"

#include <koksma/film/atomic_file.h>

#include <fmt/format.h>

#include <chrono>
#include <ctime>

namespace koksma {

namespace {

using lecture::Json;
using lecture::Topic;

std::vector<const Topic*> chosen(const std::vector<std::string>& names) {
    std::vector<const Topic*> out;
    std::string known;
    for (const Topic& t : lecture::topics()) {
        known += (known.empty() ? "" : ", ") + std::string(t.name);
        if (names.empty() || std::find(names.begin(), names.end(), t.name) != names.end()) out.push_back(&t);
    }
    for (const std::string& name : names)
        if (std::none_of(out.begin(), out.end(), [&](const Topic* t) { return t->name == name; }))
            throw UsageError(fmt::format("unknown topic '{}'; topics: {}", name, known));
    return out;
}

std::string text(const Json& cell) {
    if (cell.is_string()) return cell.get<std::string>();
    if (cell.is_number()) return fmt::format("{:.4g}", cell.get<double>());
    const auto one = [&](const char* key) {
        return cell.at(key).is_null() ? std::string("?") : fmt::format("{:.4g}", cell.at(key).get<double>());
    };
    return cell.at("lo").is_null() ? one("value") : fmt::format("{} [{}, {}]", one("value"), one("lo"), one("hi"));
}

void print_topic(const Json& t) {
    fmt::print("\n== {}: {}\n", t.at("name").get<std::string>(), t.at("title").get<std::string>());
    for (const Json& table : t.at("tables")) {
        fmt::print("{}\n", table.at("title").get<std::string>());
        std::vector<std::size_t> width;
        for (const Json& c : table.at("columns")) width.push_back(c.get<std::string>().size());
        for (const Json& row : table.at("rows"))
            for (std::size_t i = 0; i < row.size(); ++i) width[i] = std::max(width[i], text(row[i]).size());
        for (std::size_t i = 0; i < width.size(); ++i) fmt::print("  {:<{}}", table.at("columns")[i].get<std::string>(), width[i]);
        fmt::print("\n");
        for (const Json& row : table.at("rows")) {
            for (std::size_t i = 0; i < row.size(); ++i) fmt::print("  {:<{}}", text(row[i]), width[i]);
            fmt::print("\n");
        }
    }
    for (const Json& c : t.at("checks"))
        fmt::print("  {} {}: {}, closed form {:.6g}\n", c.at("held").get<bool>() ? "held   " : "REFUTED", c.at("what").get<std::string>(),
                   text(c.at("measured")), c.at("expected").get<double>());
}

}  // namespace

int run_lecture(const LectureCommand& command, const Registry& registry, const std::string& command_line) {
    const std::vector<const Topic*> wanted = chosen(command.topics);
    std::filesystem::create_directories(command.out / "pictures");
    require_writable(command.out / "lecture.json");
    const lecture::Lab lab{registry, command.out, command.seed, command.threads, command.quick};
    Json topics = Json::array();
    int held = 0, refuted = 0;
    const auto start = std::chrono::steady_clock::now();
    const std::clock_t cpu_start = std::clock();  // of all threads
    for (const Topic* topic : wanted) {
        const auto topic_start = std::chrono::steady_clock::now();
        lecture::Sheet sheet(lab, topic->name);
        topic->measure(sheet);
        Json json = {{"name", topic->name},
                     {"title", topic->title},
                     {"slide", topic->slide},
                     {"command", fmt::format("./koksma bench lecture {}", topic->name)},
                     {"seconds", std::chrono::duration<double>(std::chrono::steady_clock::now() - topic_start).count()}};
        json.update(sheet.json());
        for (const Json& c : json.at("checks")) ++(c.at("held").get<bool>() ? held : refuted);
        print_topic(json);
        std::fflush(stdout);
        topics.push_back(std::move(json));
    }
    const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    const double cpu_seconds = static_cast<double>(std::clock() - cpu_start) / CLOCKS_PER_SEC;
    const Json all = {{"command", command_line},
                      {"version", version_text()},
                      {"machine", machine().cpu},
                      {"quick", command.quick},
                      {"seed", command.seed},
                      {"seconds", seconds}, {"cpu_seconds", cpu_seconds},
                      {"held", held},
                      {"refuted", refuted},
                      {"topics", topics}};
    write_json(command.out / "lecture.json", all);
    fmt::print("\n{} closed forms held, {} refuted; {}\nnumbers: {}\n", held, refuted, duration_text(seconds),
               (command.out / "lecture.json").string());
    if (!command.no_report) draw_page("report.lecture", command.out / "lecture.json", command.out / "lecture.html");
    return refuted == 0 ? 0 : 1;
}

}  // namespace koksma
