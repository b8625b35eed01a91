#pragma once

#include <cstdint>
#include <string_view>

#include "saker/exchange_t.hpp"

/// Sealed datagrams (modules/exchange) ↔ `_EXCHANGE`.
namespace saker::flight {

/// µs of the system clock.
[[nodiscard]] std::int64_t system_utime();

[[nodiscard]] exchange_t to_lcm(std::int64_t utime, std::string_view datagram);

/// As long as the message lives.
[[nodiscard]] std::string_view datagram_of(const exchange_t& message);

}  // namespace saker::flight
