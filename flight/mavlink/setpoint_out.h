#pragma once

#include <optional>

#include "flight/mavlink/dialect.h"
#include "flight/mavlink/odometry_out.h"
#include "mavlink/messages.h"
#include "saker/core/vehicle.h"

/// The executive's setpoints → SET_POSITION_TARGET_LOCAL_NED at 50 Hz.
///
/// Place, velocity and acceleration where they are known, and yaw, in LOCAL_NED. When a setpoint
/// expires, a stop goes out at once: stand where the vehicle is. PX4 climbs by setpoints, too,
/// since it has no take-off without a global place.
namespace saker::flight::mavlink {

struct SetpointOutConfig {
  double most_age_s = 0.5;   ///< of a setpoint's expiry after its stamp: longer ones are cut
  double climb_speed = 1.0;  ///< m/s, where we climb by setpoints
  double reached_m = 0.3;    ///< below the height of a climb: it is done
};

/// Where the vehicle is, in `odom`.
struct Place {
  Eigen::Vector3d position = Eigen::Vector3d::Zero();
  double yaw = 0;
};

class SetpointOut {
 public:
  struct Counters {
    long sent = 0;
    long refused = 0;  ///< no number, out of range, of the past
    long expired = 0;  ///< stops that were sent
  };

  explicit SetpointOut(const SetpointOutConfig& config = {}) : config_(config) {}

  /// A setpoint of the executive. False where it is refused.
  /// \param sensor_now  now, in the clock of its stamps
  bool hear(const Setpoint& setpoint, Time sensor_now);

  /// `odom` began anew: what is held moves with it. The executive's next setpoint has to be of the
  /// new one, and older ones are refused.
  void follow(const OdometryReset& reset, Time sensor_now);

  /// From `here` up by `height_m`, by setpoints.
  void climb(const Place& here, double height_m, Time host_now);
  /// Stands where it is until the next setpoint.
  void stop(const Place& here);
  /// Forgets all: on the ground, or somebody else flies.
  void clear();

  [[nodiscard]] bool climbing() const { return climb_.has_value(); }
  [[nodiscard]] bool fresh(Time sensor_now) const { return newest_ && sensor_now < expiry_; }
  /// Whether the vehicle stands because the setpoint expired.
  [[nodiscard]] bool stopped() const { return held_.has_value() && !climb_; }

  /// What goes out now: the setpoint, a climb, or a stop. Call it only where the vehicle may move.
  [[nodiscard]] SetPositionTargetLocalNed tick(const Place& here, Time sensor_now, Time host_now);

  [[nodiscard]] const Counters& counters() const { return counters_; }

 private:
  struct Climb {
    Place from;
    double height_m = 0;
    Time began = 0;
  };

  [[nodiscard]] SetPositionTargetLocalNed climb_target(const Place& here, Time host_now);

  SetpointOutConfig config_;
  std::optional<Setpoint> newest_;
  Time expiry_ = 0;      // of the newest
  Time not_before_ = 0;  // stamps of an `odom` that is gone
  std::optional<Place> held_;
  std::optional<Climb> climb_;
  Counters counters_;
};

/// The message of a setpoint in `odom`. What is no number is ignored, and with the velocity the
/// acceleration: ArduPilot would drop the whole message without a word.
[[nodiscard]] SetPositionTargetLocalNed to_message(const Setpoint& setpoint, Time host_now);

}  // namespace saker::flight::mavlink
