#include "python.h"

#include <sys/wait.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <filesystem>

namespace koksma {

std::string python_program() {
    if (const char* chosen = std::getenv("KOKSMA_PYTHON")) return chosen;
    return std::filesystem::exists("/usr/bin/python3") ? "/usr/bin/python3" : "python3";
}

int run_python(const std::vector<std::string>& arguments, const std::string& python_path) {
    std::vector<std::string> words{python_program()};
    words.insert(words.end(), arguments.begin(), arguments.end());
    std::vector<char*> argv;
    for (std::string& w : words) argv.push_back(w.data());
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

}  // namespace koksma
