#include "page.h"

#include "experiment.h"
#include "python.h"

#include <koksma/film/atomic_file.h>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <fstream>

namespace koksma {

void write_json(const std::filesystem::path& file, const nlohmann::ordered_json& json) {
    write_atomically(file, [&](const std::filesystem::path& temporary) {
        std::ofstream out(temporary);
        out << json.dump(1) << '\n';
        out.flush();
        if (!out) throw Error("the disk is full or the folder is not writable");
    });
}

void draw_page(const std::string& module, const std::filesystem::path& numbers, const std::filesystem::path& page) {
    const int code = run_python({"-m", module, numbers.string(), page.string()}, (data_directory() / "bench").string());
    const std::string kept = fmt::format("the numbers are complete ({}), but there is no page: ", numbers.string());
    if (code == 127)
        throw Error(fmt::format("{}{} cannot be started; install python3, python3-numpy, python3-matplotlib and python3-jinja2", kept,
                                python_program()));
    if (code != 0) throw Error(fmt::format("{}'{} -m {}' ended with code {} (its message is above)", kept, python_program(), module, code));
}

}  // namespace koksma
