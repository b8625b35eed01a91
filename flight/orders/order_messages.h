#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "saker/autonomy/orders.h"
#include "saker/exchange/seal.h"
#include "saker/mission_t.hpp"
#include "saker/order_t.hpp"

/// An operator's orders ↔ `_ORDER`, sealed by the team's key, and replies ↔ `_MISSION`.
///
/// A sealed payload: version (1 byte), the robot's name after its length, kind (1 byte), the
/// order's id and when it was sealed (8 bytes each, µs of the system clock). The channel is
/// authenticated with it, so that what is said to one robot is nothing to another.
namespace saker::flight {

/// Nothing where the seal fails (exchange/seal.h).
[[nodiscard]] std::optional<order_t> sealed(exchange::Sealer& sealer, const std::string& robot,
                                            const autonomy::Order& order, std::int64_t utime);

enum class OrderVerdict {
  genuine,
  forged,     ///< not sealed by the team's key for this robot's channel, or cut
  replayed,   ///< heard before
  malformed,  ///< genuine, but no order that this version knows
  elsewhere,  ///< genuine, but for another robot
  late,       ///< held back by somebody, or the clocks of both differ
  overtaken,  ///< the sender has ordered something else since
};
inline constexpr int kOrderVerdicts = 7;

[[nodiscard]] const char* to_string(OrderVerdict verdict);

struct OpenedOrder {
  OrderVerdict verdict = OrderVerdict::forged;
  std::string sender;  ///< of a genuine one
  autonomy::Order order;
  double age_s = 0;  ///< negative: sealed later than now
};

/// \param since_utime  what was sealed before is late, too: a process that began anew remembers
///                     nothing of what it heard before
[[nodiscard]] OpenedOrder opened(exchange::Opener& opener, const std::string& robot,
                                 const order_t& message, std::int64_t now_utime,
                                 std::int64_t since_utime, double most_age_s);

void write_reply(const autonomy::OrderReply& reply, mission_t& message);
/// Nothing where there was no order yet, or what is there is none.
[[nodiscard]] std::optional<autonomy::OrderReply> reply_of(const mission_t& message);

}  // namespace saker::flight
