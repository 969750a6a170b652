#include "commands.h"
#include "experiment.h"
#include "python.h"
#include "report.h"
#include "summary.h"
#include "summary_images.h"

#include <koksma/film/atomic_file.h>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <fstream>

namespace koksma {

void write_summary(const std::filesystem::path& directory) {
    nlohmann::ordered_json header;
    std::vector<Row> rows;
    read_results(directory / "results.jsonl", header, rows);
    nlohmann::ordered_json summary = summarize(header, rows);
    add_image_errors(directory, header, rows, summary);
    write_atomically(directory / "summary.json", [&](const std::filesystem::path& file) {
        std::ofstream out(file);
        out << summary.dump(1) << '\n';
        out.flush();
        if (!out) throw Error("the disk is full or the folder is not writable");
    });
    print_tables(summary);
}

bool make_report(const std::filesystem::path& directory, std::string& why_not) {
    const std::string python_path = (data_directory() / "bench").string();
    const int code = run_python({"-m", "report", directory.string()}, python_path);
    if (code == 0) return true;
    why_not = code == 127 ? fmt::format("{} cannot be started; install python3, python3-numpy, python3-matplotlib and python3-jinja2", python_program())
                          : fmt::format("'{} -m report' ended with code {} (its message is above); PYTHONPATH was {}", python_program(), code, python_path);
    return false;
}

int run_report(const std::filesystem::path& directory) {
    write_summary(directory);
    std::string why_not;
    if (!make_report(directory, why_not)) throw Error("no report.html: " + why_not);
    fmt::print("\nreport: {}\n", (directory / "report.html").string());
    return 0;
}

}  // namespace koksma
