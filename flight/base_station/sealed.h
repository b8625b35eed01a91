#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "flight/bus/bus.h"
#include "flight/bus/exchange_messages.h"
#include "saker/exchange/seal.h"

/// An order of the ground to a robot as it travels to the base: when it was sealed (8 bytes, µs of
/// the system clock, little-endian) and the message's bytes, both sealed by the team's key for its
/// channel. The base opens it; what is older than an order may be was held back by somebody.
namespace saker::flight {

/// Nothing where the seal fails (exchange/seal.h).
[[nodiscard]] std::optional<std::string> sealed_order(exchange::Sealer& sealer,
                                                      const std::string& channel,
                                                      std::int64_t utime, Bus::Bytes message);

/// The message's bytes; nothing where it is not the team's, came before, or is older than
/// `most_age_s` or as much too new.
[[nodiscard]] std::optional<std::vector<std::uint8_t>> opened_order(exchange::Opener& opener,
                                                                    const std::string& channel,
                                                                    Bus::Bytes sealed,
                                                                    std::int64_t now_utime,
                                                                    double most_age_s);

}  // namespace saker::flight
