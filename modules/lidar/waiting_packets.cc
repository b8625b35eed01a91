#include "saker/lidar/waiting_packets.h"

#include <algorithm>
#include <utility>

namespace saker::lidar {

bool WaitingPackets::keep(std::span<const std::uint8_t> payload, const ArrivedReading& packet,
                          GateCause cause) {
  const bool refused = cause != GateCause::waits;
  if (refused && refused_ == kMostRefused) {
    const auto first = [](const WaitingPacket& w) { return w.cause != GateCause::waits; };
    all_.erase(std::ranges::find_if(all_, first));
    --refused_;
  }
  if (all_.size() == kMost) return false;
  all_.push_back({{payload.begin(), payload.end()}, packet, cause});
  refused_ += refused;
  return true;
}

std::optional<WaitingPacket> WaitingPackets::take(Time until) {
  if (all_.empty() || all_.front().packet.arrival > until) return std::nullopt;
  WaitingPacket first = std::move(all_.front());
  all_.pop_front();
  refused_ -= first.cause != GateCause::waits;
  return first;
}

void WaitingPackets::clear() {
  all_.clear();
  refused_ = 0;
}

}  // namespace saker::lidar
