#pragma once

#include <string>
#include <string_view>

namespace saker::core {

/// SHA-256 of the bytes, in lower-case hexadecimal (FIPS 180-4).
[[nodiscard]] std::string sha256(std::string_view bytes);

}  // namespace saker::core
