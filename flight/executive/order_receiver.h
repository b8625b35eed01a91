#pragma once

#include <atomic>
#include <cstdint>
#include <map>
#include <memory>
#include <string>

#include "flight/bus/bus.h"
#include "flight/bus/mailbox.h"
#include "flight/orders/order_messages.h"
#include "flight/process/configuration.h"

namespace saker::flight {

/// `_ORDER` → orders for the mission: only what the team's key sealed for this robot, a moment ago
/// and for the first time. Everything else is counted, with a line for the log; a member of the
/// team whose order is refused is answered with the cause: a clock that is off is learnt of on the
/// ground.
///
/// Opens on the thread that handles the bus and waits for no disk: what it has heard is kept in
/// memory, and what was sealed before it began is refused.
class OrderReceiver {
 public:
  /// Subscribes to `bus`, which has to outlive this, as `orders` and `replies`, for MISSION, have.
  /// Without the key's file all orders are refused. Throws Error where the file is no key or may be
  /// read by everybody.
  OrderReceiver(const ExchangeConfig& config, Bus& bus, BoundedQueue<autonomy::Order>& orders,
                Mailbox<autonomy::OrderReply>& replies);
  ~OrderReceiver();
  OrderReceiver(const OrderReceiver&) = delete;
  OrderReceiver& operator=(const OrderReceiver&) = delete;

  /// The key's file is there.
  [[nodiscard]] bool can_open() const { return opener_ != nullptr; }

  // Any thread.

  /// What was refused since the last call, a line each; of many at once the last few.
  [[nodiscard]] std::vector<std::string> take_lines() { return lines_.take_all(); }
  [[nodiscard]] long refused() const { return refused_; }

 private:
  bool hear(const order_t& message);
  bool refuse(OrderVerdict verdict, const OpenedOrder& order);
  void answer(OrderVerdict verdict, const OpenedOrder& order);
  [[nodiscard]] std::string detail(OrderVerdict verdict, const OpenedOrder& order) const;

  const std::string robot_;
  const double most_age_s_;
  const std::int64_t since_utime_;
  BoundedQueue<autonomy::Order>& orders_;
  Mailbox<autonomy::OrderReply>& replies_;
  int memory_ = -1;                             // the opener's file, not on a disk
  std::unique_ptr<exchange::Opener> opener_;    // null: no key
  std::map<std::string, std::int64_t> newest_;  // id by sender: the opener has a ceiling of them
  BoundedQueue<std::string> lines_{8};
  std::atomic<long> refused_ = 0;
};

}  // namespace saker::flight
