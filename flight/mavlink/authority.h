#pragma once

#include <array>
#include <optional>
#include <string>

#include "flight/mavlink/dialect.h"
#include "mavlink/messages.h"

/// Who flies: the executive, until somebody else does.
///
/// Reads modes and sticks. A mode that nobody of ours asked for is a pilot's, or a failsafe's of
/// the autopilot; either keeps the vehicle until an operator gives it back. Times are the host's.
namespace saker::flight::mavlink {

struct AuthorityConfig {
  double asked_s = 3.0;    ///< for which a mode that was asked for may come
  int stick_us = 150;      ///< of a stick away from where it was at arming: somebody holds it
  int stick_messages = 2;  ///< in a row
};

class Authority {
 public:
  enum class Holder { ours, pilot, failsafe };

  explicit Authority(const AuthorityConfig& config = {}) : config_(config) {}

  /// We ask for this mode now.
  void asked(std::uint32_t custom_mode, Time now);
  /// From HEARTBEAT.
  void hear(bool armed, std::uint32_t custom_mode, std::uint8_t system_status, Time now);
  void hear(const RcChannels& sticks);
  /// An operator's order, and nothing else: the executive flies again.
  void give_back();

  [[nodiscard]] Holder holder() const { return holder_; }
  [[nodiscard]] bool ours() const { return holder_ == Holder::ours; }
  /// Why it is not ours; empty: it is.
  [[nodiscard]] const std::string& cause() const { return cause_; }

 private:
  using Sticks = std::array<std::uint16_t, 3>;  // roll, pitch, yaw

  void take(Holder holder, std::string cause);

  AuthorityConfig config_;
  Holder holder_ = Holder::ours;
  std::string cause_;
  bool armed_ = false;
  std::optional<std::uint32_t> mode_, asked_;
  Time asked_at_ = 0;
  std::optional<Sticks> rest_;  // where the sticks were at arming
  int moved_ = 0;
};

}  // namespace saker::flight::mavlink
