#pragma once

#include "saker/core/rng.h"
#include "saker/lidar/scan.h"
#include "saker/simulation/sensor/sensor_config.h"
#include "saker/simulation/vehicle/quadrotor.h"

/// What a vehicle carries besides its LiDAR: inertial units, a barometer, a battery.
namespace saker::simulation {

/// An accelerometer and a gyroscope at `T_body_imu`, with noise and a constant bias.
class InertialUnit {
 public:
  /// `R_imu_axes`: turns readings from the body's axes into those that they are given in.
  InertialUnit(const ImuConfig& config, const Eigen::Vector3d& place_in_body,
               const Eigen::Matrix3d& R_axes_body, core::Rng rng);

  [[nodiscard]] lidar::ImuSample sample(const RigidState& state, Time stamp);

 private:
  [[nodiscard]] Eigen::Vector3d noise(double sd);

  ImuConfig config_;
  Eigen::Vector3d place_;
  Eigen::Matrix3d R_axes_body_;
  core::Rng rng_;
  Eigen::Vector3d acceleration_bias_;
  Eigen::Vector3d rotation_bias_;
};

struct BarometerConfig {
  double noise_m = 0.1;
  double drift_m = 0.3;
  double drift_time_s = 300;

  template <class Visitor>
  void visit(Visitor& v) {
    v.field("noise_m", noise_m, {0, 5}, "m", "sd of a reading");
    v.field("drift_m", drift_m, {0, 20}, "m", "sd of the weather's slow changes");
    v.field("drift_time_s", drift_time_s, {1, 10000}, "s", "correlation time of these");
  }
};

class Barometer {
 public:
  Barometer(const BarometerConfig& config, core::Rng rng);

  /// m above some level, `dt` seconds after the last reading.
  [[nodiscard]] double read(double height_m, double dt);

 private:
  BarometerConfig config_;
  core::Rng rng_;
  double drift_ = 0;
};

struct BatteryConfig {
  double capacity_wh = 130;
  double charge = 1.0;
  double electronics_w = 45;
  double watts_per_n15 = 4.3;

  template <class Visitor>
  void visit(Visitor& v) {
    v.field("capacity_wh", capacity_wh, {1, 10000}, "Wh", "when it is full");
    v.field("charge", charge, {0, 1}, "", "share of it at the start");
    v.field("electronics_w", electronics_w, {0, 1000}, "W", "LiDAR and computer");
    v.field("watts_per_n15", watts_per_n15, {0.1, 100}, "W/N^1.5",
            "a rotor's power per thrust to 3/2: momentum theory at 13 cm and 60 %");
  }
};

/// Energy that goes with thrust: power ∝ thrust^1.5 (momentum theory of a hovering rotor).
class Battery {
 public:
  explicit Battery(const BatteryConfig& config);

  void drain(double dt, const MotorThrusts& thrusts);
  [[nodiscard]] double share() const { return energy_j_ / capacity_j_; }  ///< 0 … 1
  [[nodiscard]] bool empty() const { return energy_j_ <= 0; }

 private:
  BatteryConfig config_;
  double capacity_j_;
  double energy_j_;
};

}  // namespace saker::simulation
