#pragma once

#include <deque>
#include <optional>

#include "saker/core/vehicle.h"
#include "saker/simulation/vehicle/geometric_controller.h"
#include "saker/simulation/vehicle/vehicle_estimator.h"

namespace saker::simulation {

struct FlightControllerConfig {
  double takeoff_speed_mps = 0.8;
  double least_takeoff_m = 0.5;
  double most_takeoff_m = 30;
  double land_speed_mps = 0.6;
  double descend_speed_mps = 0.6;
  double brake_mps2 = 1.5;
  double coast_s = 6;
  double hold_s = 8;
  double idle_s = 60;
  double touchdown_s = 0.4;
  double touchdown_thrust = 0.6;
  double touchdown_speed_mps = 0.2;
  double battery_low = 0.2;
  double battery_critical = 0.08;
  GeometricControllerConfig control;
  VehicleEstimatorConfig estimator;

  template <class Visitor>
  void visit(Visitor& v) {
    v.field("takeoff_speed_mps", takeoff_speed_mps, {0.1, 5}, "m/s", "of the climb");
    v.field("least_takeoff_m", least_takeoff_m, {0.1, 10}, "m", "lower ones are refused");
    v.field("most_takeoff_m", most_takeoff_m, {1, 200}, "m", "higher ones are refused");
    v.field("land_speed_mps", land_speed_mps, {0.1, 3}, "m/s", "with odometry");
    v.field("descend_speed_mps", descend_speed_mps, {0.1, 3}, "m/s",
            "on inertial unit and barometer: slow enough for a touchdown unseen");
    v.field("brake_mps2", brake_mps2, {0.1, 10}, "m/s²", "from setpoints that stopped to hold");
    v.field("coast_s", coast_s, {0, 20}, "s",
            "of standing still by the inertial unit when odometry stops: 0.3 m/s off by then, less "
            "than wind does to one that levels; then it levels");
    v.field("hold_s", hold_s, {0.5, 600}, "s", "of hold without a setpoint before it lands");
    v.field("idle_s", idle_s, {1, 3600}, "s", "armed on the ground before it disarms");
    v.field("touchdown_s", touchdown_s, {0.05, 5}, "s", "standing still before it disarms");
    v.field("touchdown_thrust", touchdown_thrust, {0.1, 0.9}, "",
            "of the weight: who stands still on less stands on the ground");
    v.field("touchdown_speed_mps", touchdown_speed_mps, {0.01, 1}, "m/s", "that is standing still");
    v.field("battery_low", battery_low, {0, 1}, "", "share at which it is a fault");
    v.field("battery_critical", battery_critical, {0, 1}, "", "share at which it lands");
    v.group("control", control, "from where it should be to motor thrusts");
    v.group("estimator", estimator, "where it is");
  }
};

/// The flight controller: stabilises the vehicle, obeys commands and setpoints, and comes down by
/// itself when setpoints or odometry stop.
///
/// In: readings of its inertial unit (body axes, 200 to 1000 Hz) and barometer, the battery's
/// share, odometry, setpoints and commands, all in the sensor's time. Nothing else: it knows no
/// truth. Out: thrusts of the motors, state, acknowledgements. Frames: `odom` where there is
/// odometry, a level frame with a heading of its own where there is none.
///
///     idle → takeoff → hold ⇄ guided        setpoints expire: hold; for hold_s: land
///     any of these → land                   command, battery
///     any of these → descend                odometry stops or is rejected; never back: who was
///                                           silent or lied is not trusted, and it has drifted
///     land, descend → idle, disarmed        touchdown
///
/// A hold command lasts until a setpoint with a later stamp. Cost: about 2 µs an update.
class FlightController {
 public:
  /// Throws Error on an invalid value.
  FlightController(const FlightControllerConfig& config, const AirframeConfig& airframe);

  void receive(const VehicleOdometry& odometry);
  void receive(const Setpoint& setpoint);
  void receive(const Command& command);

  /// One reading of the inertial unit, and of the barometer where there is a new one (m).
  [[nodiscard]] MotorThrusts update(const lidar::ImuSample& sample,
                                    std::optional<double> barometer_m, double battery_share);

  [[nodiscard]] VehicleState state() const;
  /// Where it takes itself to be, in `odom`.
  [[nodiscard]] const OdometryEstimator& odometry() const { return estimator_.odometry(); }
  [[nodiscard]] std::vector<CommandAck> take_acks();
  /// Why odometry is or was last doubted, for the log.
  [[nodiscard]] const char* odometry_doubt() const { return estimator_.doubt(); }

 private:
  [[nodiscard]] bool flying() const { return armed_ && mode_ != VehicleMode::idle; }
  [[nodiscard]] double seconds_in_mode() const { return to_seconds(now_ - mode_since_); }
  [[nodiscard]] const char* refusal(const Command& command) const;
  [[nodiscard]] const char* arm_refusal() const;
  [[nodiscard]] const char* takeoff_refusal(double height_m) const;
  void obey(const Command& command);
  void start_takeoff(double height_m);

  void enter(VehicleMode mode);
  void disarm();
  void advance_mode(double dt);
  void advance_takeoff();
  void watch_touchdown(double dt);
  [[nodiscard]] bool has_setpoint() const;

  [[nodiscard]] MotorThrusts control(double dt);
  [[nodiscard]] MotorThrusts follow(double dt);
  [[nodiscard]] MotorThrusts descend(double dt);
  void advance_reference(double dt);
  void brake(double dt);
  [[nodiscard]] FlightReference at_now(const Setpoint& setpoint) const;

  FlightControllerConfig config_;
  AirframeConfig airframe_;
  GeometricController controller_;
  VehicleEstimator estimator_;

  Time now_ = 0;
  Time last_barometer_ = 0;
  bool armed_ = false;
  VehicleMode mode_ = VehicleMode::idle;
  Time mode_since_ = 0;
  double armed_height_ = 0;  // m, barometer
  double battery_share_ = NAN;

  std::optional<Setpoint> setpoint_;
  bool setpoint_expired_ = false;
  Time setpoints_after_ = 0;
  FlightReference reference_;
  double takeoff_to_ = NAN;      // m, odom
  double descend_height_ = NAN;  // m, barometer: the reference of mode descend
  double descend_yaw_ = 0;
  bool coasts_ = false;
  bool lied_to_ = false;  // by odometry, in this flight
  double standing_s_ = 0;
  double thrust_ = 0;  // N, commanded last

  std::optional<CommandAck> last_ack_;
  std::deque<CommandAck> acks_;
};

}  // namespace saker::simulation
