#pragma once

#include <cstdint>
#include <deque>
#include <optional>
#include <span>
#include <vector>

#include "saker/lidar/gate_cause.h"
#include "saker/lidar/sensor_candidates.h"

namespace saker::lidar {

struct WaitingPacket {
  std::vector<std::uint8_t> payload;
  ArrivedReading packet;
  GateCause cause = GateCause::waits;  ///< or what it was refused by, as stamped
};

/// Inertial packets of which it is not known yet by which clock they were stamped, in the order of
/// their arrival; 64 at most, which is 0.6 s. For the gate (sensor_gate.h).
///
/// Those that were refused as they are stamped are kept as well, the last sixteen: by the clock
/// that stepped they may be right.
class WaitingPackets {
 public:
  static constexpr std::size_t kMost = 64, kMostRefused = 16;

  /// False: there is no room.
  [[nodiscard]] bool keep(std::span<const std::uint8_t> payload, const ArrivedReading& packet,
                          GateCause cause);
  /// The next one of those that arrived until then.
  [[nodiscard]] std::optional<WaitingPacket> take(Time until);

  /// Whether one that was not refused is among them.
  [[nodiscard]] bool any_due() const { return refused_ < all_.size(); }
  [[nodiscard]] bool empty() const { return all_.empty(); }
  [[nodiscard]] Time oldest_arrival() const { return all_.front().packet.arrival; }
  [[nodiscard]] std::deque<WaitingPacket>& all() { return all_; }
  void clear();

 private:
  std::deque<WaitingPacket> all_;
  std::size_t refused_ = 0;  // of them
};

}  // namespace saker::lidar
