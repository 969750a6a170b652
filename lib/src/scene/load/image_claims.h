#pragma once
// What a picture file claims against what it can hold. Decoders allocate and index by the claim, before they read.

#include <cstdint>
#include <string>

namespace koksma::loader {

/// @param bytes  a PNG, JPEG or Radiance HDR file
/// @throws Error naming the claim: a PNG chunk that ends beyond the file, or a JPEG's Huffman table of more than 256 codes
void check_claims(const std::string& bytes, const std::string& name);

/// @throws Error for more pixels than that many bytes can encode
void check_size(const std::string& bytes, std::int64_t width, std::int64_t height, const std::string& name);

}  // namespace koksma::loader
