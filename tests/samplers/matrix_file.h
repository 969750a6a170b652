#pragma once
// Generator matrices as a file, for tests that read one.

#include <cstdint>
#include <cstdio>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

namespace koksma::test {

/// The Faure sequence (Pascal matrices to the power of the dimension) in base b, as a file.
[[nodiscard]] inline std::string faure_text(std::uint32_t b, std::uint32_t dimensions, std::uint32_t rows, std::uint32_t columns) {
    std::string text = "# Faure\nkoksma-matrices 1\nbase " + std::to_string(b) + "\ndimensions " + std::to_string(dimensions) + "\nrows " +
                       std::to_string(rows) + "   # of each matrix\ncolumns " + std::to_string(columns) + "\n";
    std::vector<std::vector<std::uint32_t>> binomial(columns, std::vector<std::uint32_t>(rows, 0));
    for (std::uint32_t c = 0; c < columns; ++c)
        for (std::uint32_t r = 0; r <= c && r < rows; ++r) binomial[c][r] = r == 0 || r == c ? 1 : (binomial[c - 1][r - 1] + binomial[c - 1][r]) % b;
    for (std::uint32_t d = 0; d < dimensions; ++d) {
        text += "\nmatrix " + std::to_string(d) + "\n";
        for (std::uint32_t r = 0; r < rows; ++r, text += "\n")
            for (std::uint32_t c = 0; c < columns; ++c) {
                std::uint32_t entry = binomial[c][r];
                for (std::uint32_t k = r; k < c; ++k) entry = entry * d % b;
                text += std::to_string(entry) + " ";
            }
    }
    return text;
}

/// Lives as long as this object.
class File {
public:
    explicit File(const std::string& text) : path((std::filesystem::temp_directory_path() / ("koksma_test_matrices=a:b_" + std::to_string(::getpid()) + ".txt")).string()) {
        std::ofstream(path) << text;
    }
    ~File() { std::remove(path.c_str()); }
    File(const File&) = delete;
    File& operator=(const File&) = delete;
    const std::string path;
};

}  // namespace koksma::test
