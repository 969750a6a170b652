#include "commands.h"
#include "experiment.h"
#include "report.h"
#include "summary.h"

#include <koksma/film/atomic_file.h>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <sys/wait.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <fstream>

namespace koksma {

namespace {

/// Runs a program with an argument list (no shell). @return its exit code, 127 if it could not be started
int run_program_with(const std::vector<std::string>& words, const std::string& python_path) {
    std::vector<char*> argv;
    for (const std::string& w : words) argv.push_back(const_cast<char*>(w.c_str()));
    argv.push_back(nullptr);
    std::fflush(stdout);  // the tables come before what the child prints
    const pid_t child = ::fork();
    if (child == 0) {
        ::setenv("PYTHONPATH", python_path.c_str(), 1);
        ::setenv("PYTHONDONTWRITEBYTECODE", "1", 1);
        ::execvp(argv[0], argv.data());
        ::_exit(127);
    }
    int status = 0;
    if (child < 0 || ::waitpid(child, &status, 0) < 0) return 127;
    return WIFEXITED(status) ? WEXITSTATUS(status) : 1;
}

/// The Python that has the packages of the distribution, unless the user names another.
std::string python() {
    if (const char* chosen = std::getenv("KOKSMA_PYTHON")) return chosen;
    return std::filesystem::exists("/usr/bin/python3") ? "/usr/bin/python3" : "python3";
}

}  // namespace

void write_summary(const std::filesystem::path& directory) {
    nlohmann::ordered_json header;
    std::vector<Row> rows;
    read_results(directory / "results.jsonl", header, rows);
    const nlohmann::ordered_json summary = summarize(header, rows);
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
    const int code = run_program_with({python(), "-m", "report", directory.string()}, python_path);
    if (code == 0) return true;
    why_not = code == 127 ? fmt::format("{} cannot be started; install python3, python3-numpy, python3-matplotlib and python3-jinja2", python())
                          : fmt::format("'{} -m report' ended with code {} (its message is above); PYTHONPATH was {}", python(), code, python_path);
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
