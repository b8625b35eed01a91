#include "flight/executive/order_receiver.h"

#include <fmt/format.h>
#include <spdlog/spdlog.h>
#include <sys/mman.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>

#include "flight/bus/exchange_messages.h"
#include "saker/core/error.h"

namespace saker::flight {

OrderReceiver::OrderReceiver(const ExchangeConfig& config, Bus& bus,
                             BoundedQueue<autonomy::Order>& orders)
    : robot_(bus.robot()),
      most_age_s_(config.order_age_s),
      since_utime_(system_utime()),
      orders_(orders) {
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
  if (verdict == OrderVerdict::late) line += fmt::format(", {:.1f} s ago", order.age_s);
  lines_.push(std::move(line));
  return false;
}

}  // namespace saker::flight
