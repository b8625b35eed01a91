#pragma once

#include <array>
#include <optional>
#include <string>

#include "flight/mavlink/dialect.h"
#include "flight/mavlink/frame.h"
#include "saker/core/vehicle.h"

/// The autopilot's messages → its state, as the executive knows it.
///
/// Reads frames of one system and component, with the host's time at which they came; what is out
/// of range counts as unknown. Attitude and places come in our frames (frames.h).
namespace saker::flight::mavlink {

inline constexpr double kSilence = 2.5;  ///< s without HEARTBEAT (1 Hz): the line is down

/// What was heard last. NaN and nothing: unknown.
struct AutopilotState {
  bool armed = false;
  std::uint32_t custom_mode = 0;
  std::uint8_t system_status = 0;
  Landed landed = Landed::unknown;
  Eigen::Quaterniond attitude = Eigen::Quaterniond::Identity();
  Eigen::Vector3d position = Eigen::Vector3d::Constant(NAN);  ///< by its estimator, as `odom`
  double battery_share = NAN;                                 ///< of the emptiest pack
  double cell_volts = NAN;                                    ///< of the lowest cell
  std::optional<std::uint16_t> estimator_flags;
  bool has_origin = false;
  std::string text;  ///< its last one of warning or worse
};

class StateIn {
 public:
  static constexpr int kMostPacks = 4;

  /// \param system  of the autopilot; 0: of the first that says HEARTBEAT
  StateIn(const Dialect& dialect, std::uint8_t system) : dialect_(dialect), system_(system) {}

  /// False where the frame is not of the autopilot, or says nothing of its state.
  bool hear(const Frame& frame, Time now);

  /// The autopilot began anew: it has no origin.
  void forget_origin() { state_.has_origin = false; }

  /// Whether the autopilot that was configured is there and speaks.
  [[nodiscard]] bool connected(Time now) const;
  [[nodiscard]] std::uint8_t system() const { return system_; }
  /// Why the autopilot is not believed; empty: it is.
  [[nodiscard]] const std::string& refusal() const { return refusal_; }
  [[nodiscard]] const AutopilotState& state() const { return state_; }
  /// m, above where it was armed; NaN: unknown.
  [[nodiscard]] double height_m() const;
  [[nodiscard]] bool estimator_good() const;
  /// Whether a message of this kind came within `seconds`.
  [[nodiscard]] bool came(std::uint32_t id, double seconds, Time now) const;

 private:
  struct Pack {
    double share = NAN, cell_volts = NAN;
  };

  bool identify(const Frame& frame, Time now);
  void hear(const Heartbeat& message, Time now);
  void hear(const BatteryStatus& message);
  void hear(const AttitudeQuaternion& message);
  void hear(const LocalPositionNed& message);
  void hear(const Statustext& message);

  Dialect dialect_;
  std::uint8_t system_;
  std::string refusal_;
  AutopilotState state_;
  std::array<Pack, kMostPacks> packs_{};
  double ground_z_ = NAN;  // where it was armed
  Time heartbeat_at_ = 0;
  std::array<Time, kDefinitions.size()> came_{};  // by definition
};

/// The asking for messages that the autopilot sends too seldom by itself: SET_MESSAGE_INTERVAL.
struct Wanted {
  std::uint32_t id = 0;
  double rate_hz = 0;
};
[[nodiscard]] std::array<Wanted, 9> wanted_messages(const Dialect& dialect);

}  // namespace saker::flight::mavlink
