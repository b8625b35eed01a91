#pragma once

#include <optional>

#include "flight/mavlink/clocks.h"
#include "saker/core/vehicle.h"

/// Our odometry → ODOMETRY, and whether it is good enough to fly on.
///
/// Reads `VehicleOdometry` in `odom` (continuous; the corrected `world` never comes here) with the
/// host's time at which it came. Makes ODOMETRY in LOCAL_FRD with FRD as child (ArduPilot takes no
/// other), estimator VIO (PX4 refuses LIDAR), at most once in 25 ms (ArduPilot takes one in 20 ms,
/// PX4 needs one in 200 ms), stamped in the host's clock. After a lie nothing is made until
/// odometry was good for a while: then its reset counter goes up, so that nobody flies the jump
/// back.
namespace saker::flight::mavlink {

/// Constants of the method, in SI units.
struct OdometryOutConfig {
  double least_period_s = 0.025;
  double most_age_s = 0.2;     ///< of good odometry: LAND has to be there within 0.3 s of the last
  double velocity_sd = 0.1;    ///< m/s: what is fitted to scans at 10 Hz; ours does not say it
  double most_speed = 30;      ///< m/s; faster is a lie
  double jump_m = 0.5;         ///< beyond what the velocity explains, without a reset: a lie
  double frozen_speed = 0.3;   ///< m/s said while the place stays the same to the bit: frozen …
  double frozen_s = 0.15;      ///< … for so long
  double trust_again_s = 1.0;  ///< of good odometry, after what was none
};

/// `odom` began anew: what was `p_old` there is T_new_old * p_old now.
struct OdometryReset {
  SE3 T_new_old = SE3::Identity();
  double yaw = 0;  ///< rad, of it
};

class OdometryOut {
 public:
  struct Counters {
    long sent = 0;
    long refused = 0;  ///< no number, out of range, of the past
    long lies = 0;     ///< jumps and frozen places
    long resets = 0;
  };

  struct Result {
    std::optional<Odometry> message;
    std::optional<OdometryReset> reset;  ///< setpoints have to follow it in the same tick
  };

  explicit OdometryOut(const OdometryOutConfig& config = {}) : config_(config) {}

  /// \param fresh  else it is believed, but goes out only where it is a reset
  [[nodiscard]] Result hear(const VehicleOdometry& odometry, Time host_now, bool fresh = true);

  /// From when on what is heard goes out, where it is good.
  [[nodiscard]] Time next() const {
    return sent_at_ == 0 ? 0 : sent_at_ + from_seconds(config_.least_period_s);
  }

  /// Whether there is odometry to fly on: good, and young enough.
  [[nodiscard]] bool good(Time host_now) const;

  /// The newest that was believed. Nothing before the first.
  [[nodiscard]] const std::optional<VehicleOdometry>& newest() const { return newest_; }

  /// From the odometry's stamp, in the host's clock, to when it was handed on. s; NaN before.
  [[nodiscard]] double latency_s() const { return latency_s_; }
  [[nodiscard]] const SensorToHost& clock() const { return clock_; }
  [[nodiscard]] const Counters& counters() const { return counters_; }

 private:
  [[nodiscard]] bool plausible(const VehicleOdometry& odometry);
  [[nodiscard]] bool frozen(const VehicleOdometry& odometry);
  [[nodiscard]] Odometry message(const VehicleOdometry& odometry, Time host_stamp) const;
  [[nodiscard]] OdometryReset reset_to(const VehicleOdometry& odometry) const;

  OdometryOutConfig config_;
  SensorToHost clock_;
  std::optional<VehicleOdometry> newest_;
  Time same_place_since_ = 0;       // by stamps
  std::optional<Time> good_since_;  // host's time
  Time good_at_ = 0, sent_at_ = 0;  // host's time
  bool lied_ = false;               // and what came since is not trusted yet
  std::uint8_t reset_count_ = 0;    // on the wire
  double latency_s_ = NAN;
  Counters counters_;
};

}  // namespace saker::flight::mavlink
