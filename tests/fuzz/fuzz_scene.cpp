// Scene files, with the meshes and pictures of the corpus folder beside them (KOKSMA_FUZZ_FILES).

#include "fuzz_file.h"

#include <koksma/scene/load.h>

#include <fstream>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    static const std::filesystem::path folder = [] {
        const char* files = std::getenv("KOKSMA_FUZZ_FILES");
        auto made = std::filesystem::temp_directory_path() / ("koksma-fuzz-" + std::to_string(getpid()));
        std::filesystem::create_directories(made);
        if (files != nullptr) std::filesystem::copy(files, made, std::filesystem::copy_options::recursive | std::filesystem::copy_options::overwrite_existing);
        return made;
    }();
    std::ofstream(folder / "scene.xml", std::ios::binary).write(reinterpret_cast<const char*>(data), static_cast<std::streamsize>(size));
    koksma::fuzz::expect_error_at_most([&] { (void)koksma::load_scene(folder / "scene.xml"); });
    return 0;
}
