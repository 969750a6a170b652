// Writes what became of each test case of a row of the catalogue, for summary.py: row, kernel, outcome, worst error as a share of what is
// allowed, that error, its noise, its tolerance, name.

#define CATCH_CONFIG_EXTERNAL_INTERFACES
#include <scenes/render_scene.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>

namespace koksma::testing {

namespace {

#if __has_include(<catch2/catch_all.hpp>)
using Listener = Catch::EventListenerBase;
#else
using Listener = Catch::TestEventListenerBase;
#endif

class RowRecord : public Listener {
public:
    using Listener::Listener;
    void testCaseStarting(const Catch::TestCaseInfo& info) override {
        worst_check() = {};
        name_ = info.name;
        write("crashed");  // until it ends
    }
    void testCaseEnded(const Catch::TestCaseStats& stats) override {
        const auto& cases = stats.totals.testCases;
        write(cases.failed > 0 ? "failed" : cases.failedButOk > 0 ? "expected-failure" : "held");
    }

private:
    void write(const char* outcome) const {
        const char* const kernel = std::getenv("KOKSMA_TEST_KERNEL");
        std::string file;
        for (const char c : name_ + (kernel ? kernel : "")) file += std::isalnum(static_cast<unsigned char>(c)) ? c : '-';
        std::error_code ignored;  // a run by hand may have no such folder
        std::filesystem::create_directories(KOKSMA_HARD_RECORDS, ignored);
        std::ofstream out(std::filesystem::path(KOKSMA_HARD_RECORDS) / (file + ".tsv"));
        const WorstCheck& w = worst_check();
        out << name_.substr(0, name_.find(':')) << '\t' << (kernel ? kernel : "batch") << '\t' << outcome << '\t';
        if (w.tolerance > 0.0)
            out << w.share << '\t' << w.error << '\t' << w.noise << '\t' << w.tolerance;
        else
            out << "\t\t\t";
        out << '\t' << name_ << '\n';
    }
    std::string name_;
};

CATCH_REGISTER_LISTENER(RowRecord)

}  // namespace

}  // namespace koksma::testing
