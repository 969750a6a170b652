// OBJ, PLY and serialized meshes, and volumes, told apart by how they begin.

#include "fuzz_file.h"

#include <koksma/scene/load.h>

#include <string_view>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const std::string_view bytes(reinterpret_cast<const char*>(data), size);
    const auto file = koksma::fuzz::file_of(data, size);
    koksma::fuzz::expect_error_at_most([&] {
        if (bytes.starts_with("ply"))
            (void)koksma::load_ply(file);
        else if (bytes.starts_with("VOL"))
            (void)koksma::load_vol(file);
        else if (bytes.starts_with("\x1c\x04"))
            (void)koksma::load_serialized(file, size % 4 == 0 ? 1 : 0);
        else
            (void)koksma::load_obj(file);
    });
    return 0;
}
