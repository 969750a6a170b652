#pragma once
// Scenes written into a directory that goes away with the test.

#include <koksma/sampling/error.h>
#include <koksma/scene/load.h>

#include <atomic>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>

namespace koksma::testing {

inline const std::string kSensor = R"(<sensor type="perspective"><film type="hdrfilm"><rfilter type="box"/></film></sensor>)";

class SceneFiles {
public:
    SceneFiles() {
        static std::atomic<int> count{0};
        const auto now = std::chrono::steady_clock::now().time_since_epoch().count();
        directory_ = std::filesystem::temp_directory_path() / ("koksma-scene-" + std::to_string(now) + "-" + std::to_string(count++));
        std::filesystem::create_directories(directory_);
    }
    ~SceneFiles() {
        std::error_code ignored;
        std::filesystem::remove_all(directory_, ignored);
    }
    SceneFiles(const SceneFiles&) = delete;
    SceneFiles& operator=(const SceneFiles&) = delete;

    std::filesystem::path write(const std::string& name, std::string_view bytes) const {
        const auto file = directory_ / name;
        std::filesystem::create_directories(file.parent_path());
        std::ofstream(file, std::ios::binary) << bytes;
        return file;
    }
    /// Loads text as it is.
    SceneDescription load_text(const std::string& text, const SceneParameters& parameters = {}) const {
        return load_scene(write("scene.xml", text), parameters);
    }
    /// Loads the contents of a <scene> whose first line holds the tag alone; a sensor is added after it.
    SceneDescription load(const std::string& contents, const SceneParameters& parameters = {}) const {
        return load_text(whole(contents), parameters);
    }
    std::string error_of_text(const std::string& text, const SceneParameters& parameters = {}) const {
        try {
            (void)load_text(text, parameters);
        } catch (const Error& e) {
            return e.what();
        }
        return "no error";
    }
    std::string error_of(const std::string& contents, const SceneParameters& parameters = {}) const {
        return error_of_text(whole(contents), parameters);
    }
    static std::string whole(const std::string& contents) {
        return "<scene version=\"3.0.0\">\n" + contents + "\n" + kSensor + "\n</scene>\n";
    }
    [[nodiscard]] const std::filesystem::path& directory() const noexcept { return directory_; }

private:
    std::filesystem::path directory_;
};

/// The message of the Error that `f` throws.
template <class F>
std::string error_from(F&& f) {
    try {
        f();
    } catch (const Error& e) {
        return e.what();
    }
    return "no error";
}

/// True if every part is in the text; a failing check shows the text.
inline bool has(const std::string& text, std::initializer_list<std::string_view> parts) {
    for (const auto part : parts)
        if (text.find(part) == std::string::npos) return false;
    return true;
}

}  // namespace koksma::testing
