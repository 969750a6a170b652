// Pictures: PNG, JPEG, Radiance HDR, OpenEXR.

#include "fuzz_file.h"

#include <koksma/scene/load.h>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const auto file = koksma::fuzz::file_of(data, size);
    koksma::fuzz::expect_error_at_most([&] { (void)koksma::load_image(file, size % 2 == 0); });
    return 0;
}
