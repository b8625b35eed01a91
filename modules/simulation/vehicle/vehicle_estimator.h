#pragma once

#include <optional>

#include "saker/simulation/vehicle/inertial_estimator.h"
#include "saker/simulation/vehicle/odometry_estimator.h"

namespace saker::simulation {

struct VehicleEstimatorConfig {
  double most_age_s = 0.5;
  double doubt_time_s = 0.25;
  double tilt_gate_deg = 12;
  double height_gate_m = 1.5;
  double height_time_s = 30;
  InertialEstimatorConfig inertial;
  OdometryEstimatorConfig odometry;

  template <class Visitor>
  void visit(Visitor& v) {
    v.field("most_age_s", most_age_s, {0.05, 30}, "s",
            "older odometry is none: the inertial unit carries a position so long");
    v.field("doubt_time_s", doubt_time_s, {0, 5}, "s",
            "of odometry that is not believed, before it is rejected");
    v.field("tilt_gate_deg", tilt_gate_deg, {1, 90}, "°",
            "of the odometry's vertical to the accelerometer's");
    v.field("height_gate_m", height_gate_m, {0.2, 20}, "m",
            "of the odometry's height to the barometer's");
    v.field("height_time_s", height_time_s, {1, 1000}, "s",
            "in which the barometer may drift away from the odometry");
    v.group("inertial", inertial, "what is known without odometry");
    v.group("odometry", odometry, "odometry brought up to now by the inertial unit");
  }
};

/// Two estimates beside each other: one from the inertial unit and the barometer alone, which
/// odometry never touches, and one that follows odometry as long as the first does not contradict
/// it. Says whether odometry can be flown on.
class VehicleEstimator {
 public:
  explicit VehicleEstimator(const VehicleEstimatorConfig& config);

  void propagate(const lidar::ImuSample& sample, double dt);
  void correct_height(double barometer_m, double dt) { inertial_.correct_height(barometer_m, dt); }

  /// Odometry in the order of its stamps; others are ignored, as is `lost`. Where `odom` jumped
  /// (reset_counter): T_after_before of the body in it.
  std::optional<SE3> receive(const VehicleOdometry& odometry);

  /// For who has learnt that odometry lied: undoes what it said lately.
  void take_back() { odometry_.take_back(); }

  [[nodiscard]] bool trusted() const { return faults() == 0; }
  [[nodiscard]] std::uint32_t faults() const;  ///< VehicleFault bits of odometry
  /// Why odometry is rejected or was doubted last; empty where it never was.
  [[nodiscard]] const char* doubt() const { return doubt_; }

  [[nodiscard]] const InertialEstimator& inertial() const { return inertial_; }
  [[nodiscard]] const OdometryEstimator& odometry() const { return odometry_; }

 private:
  [[nodiscard]] OdometryDoubt contradiction(const VehicleOdometry& odometry, double dt);
  [[nodiscard]] SE3 pose() const;
  [[nodiscard]] bool rejected() const;

  VehicleEstimatorConfig config_;
  InertialEstimator inertial_;
  OdometryEstimator odometry_;
  Time now_ = 0;
  Time last_stamp_ = 0;
  Time doubted_since_ = 0;
  int reset_counter_ = 0;
  double height_offset_ = 0;  // the odometry's height − the barometer's
  const char* doubt_ = "";
};

}  // namespace saker::simulation
