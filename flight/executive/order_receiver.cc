#include "flight/executive/order_receiver.h"

#include <fmt/format.h>
#include <spdlog/spdlog.h>
#include <sys/mman.h>
#include <unistd.h>

#include <cerrno>
#include <cmath>
#include <cstring>
#include <filesystem>

#include "flight/bus/exchange_messages.h"
#include "saker/core/error.h"

namespace saker::flight {

OrderReceiver::OrderReceiver(const ExchangeConfig& config, Bus& bus,
                             BoundedQueue<autonomy::Order>& orders,
                             Mailbox<autonomy::OrderReply>& replies)
    : robot_(bus.robot()),
      most_age_s_(config.order_age_s),
      since_utime_(system_utime()),
      orders_(orders),
      replies_(replies) {
  if (std::filesystem::exists(config.key_file)) {
    memory_ = ::memfd_create("orders", MFD_CLOEXEC);
    if (memory_ < 0) throw Error(fmt::format("no memory for orders: {}", std::strerror(errno)));
    opener_ = std::make_unique<exchange::Opener>(exchange::read_key(config.key_file), robot_,
                                                 fmt::format("/proc/self/fd/{}", memory_));
  } else {
    spdlog::info("no key of a team at {}: orders from the ground are refused, SIGTERM lands",
                 config.key_file);
  }
  bus.subscribe<order_t>([this](const order_t& message) { return hear(message); });
}

OrderReceiver::~OrderReceiver() {
  if (memory_ >= 0) ::close(memory_);
}

bool OrderReceiver::hear(const order_t& message) {
  if (!opener_) {
    ++refused_;
    lines_.push("an order is refused: there is no key of a team to open it by");
    return false;
  }
  const OpenedOrder order =
      opened(*opener_, robot_, message, system_utime(), since_utime_, most_age_s_);
  if (order.verdict != OrderVerdict::genuine) return refuse(order.verdict, order);
  std::int64_t& newest = newest_[order.sender];
  if (order.order.id < newest) return refuse(OrderVerdict::overtaken, order);
  newest = order.order.id;
  orders_.push(order.order);  // the same once more: the mission answers it again
  return true;
}

bool OrderReceiver::refuse(OrderVerdict verdict, const OpenedOrder& order) {
  ++refused_;
  std::string line = fmt::format("an order is refused: {}", to_string(verdict));
  if (!order.sender.empty()) line += fmt::format(" ({})", order.sender);
  lines_.push(line + detail(verdict, order));
  answer(verdict, order);
  return false;
}

/// Not where it may be a copy, held back, of an order that was taken.
void OrderReceiver::answer(OrderVerdict verdict, const OpenedOrder& order) {
  const auto newest = newest_.find(order.sender);
  const bool taken = newest != newest_.end() && order.order.id == newest->second;
  if ((verdict != OrderVerdict::late && verdict != OrderVerdict::overtaken) || taken) return;
  replies_.put(autonomy::OrderReply{order.order, autonomy::OrderState::refused,
                                    to_string(verdict) + detail(verdict, order)});
}

std::string OrderReceiver::detail(OrderVerdict verdict, const OpenedOrder& order) const {
  if (verdict != OrderVerdict::late) return "";
  if (std::abs(order.age_s) <= most_age_s_) return ": it is older than this process";
  return fmt::format(": the robot's is {:.1f} s {}", std::abs(order.age_s),
                     order.age_s > 0 ? "ahead" : "behind");
}

}  // namespace saker::flight
