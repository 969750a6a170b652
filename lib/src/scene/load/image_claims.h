#pragma once
// What a picture file claims against what it can hold. Decoders allocate by the claim, before they read.

#include <cstdint>
#include <string>

namespace koksma::loader {

/// @param bytes  a PNG, JPEG or Radiance HDR file
/// @throws Error naming the claim: more pixels than that many bytes can encode, or a PNG chunk that ends beyond the file
void check_claims(const std::string& bytes, std::int64_t width, std::int64_t height, const std::string& name);

}  // namespace koksma::loader
