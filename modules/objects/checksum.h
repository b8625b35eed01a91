#pragma once

#include <cstdint>
#include <string_view>

namespace saker::objects {

/// CRC-32 of IEEE 802.3, as in zip files.
[[nodiscard]] std::uint32_t checksum(std::string_view bytes);

}  // namespace saker::objects
