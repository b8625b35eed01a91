#pragma once

#include <string>
#include <string_view>

namespace saker::segmentation {

/// SHA-256 of the bytes, in lower-case hexadecimal (FIPS 180-4).
[[nodiscard]] std::string sha256(std::string_view bytes);

}  // namespace saker::segmentation
