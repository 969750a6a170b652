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
    add_crops(directory, header, rows, summary);
    write_atomically(directory / "summary.json", [&](const std::filesystem::path& file) {
        std::ofstream out(file);
        out << summary.dump(1) << '\n';
        out.flush();
        if (!out) throw Error("the disk is full or the folder is not writable");
    });
    print_tables(summary);
}

bool make_report(const std::filesystem::path& directory, std::string& why_not, const std::vector<std::string>& more) {
    const std::string python_path = (data_directory() / "bench").string();
    std::vector<std::string> words{"-m", "report", directory.string()};
    words.insert(words.end(), more.begin(), more.end());
    const int code = run_python(words, python_path);
    if (code == 0) return true;
    why_not = code == 127 ? fmt::format("{} cannot be started; install python3, python3-numpy, python3-matplotlib and python3-jinja2", python_program())
                          : fmt::format("'{} -m report' ended with code {} (its message is above); PYTHONPATH was {}", python_program(), code, python_path);
    return false;
}

int run_report(const ReportCommand& command) {
    write_summary(command.directory);
    std::vector<std::string> more;
    if (!command.figures.empty()) more.insert(more.end(), {"--figures", command.figures.string()});
    if (command.anonymous) more.emplace_back("--anonymous");
    std::string why_not;
    if (!make_report(command.directory, why_not, more)) throw Error("no report.html: " + why_not);
    return 0;  // the package has printed what it wrote
}

}  // namespace koksma
