#include <fmt/format.h>
#include <gtest/gtest.h>

#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "saker/autonomy/safety.h"

// Each input of safety, of which nothing is known: it is never fine.
namespace saker::autonomy {
namespace {

constexpr Time kNow = 100 * kNanosecondsPerSecond;
constexpr Time kStep = kNanosecondsPerSecond / 50;

/// Flies where nothing is wrong.
SafetyInput good(Time now) {
  SafetyInput input;
  input.now = now;
  input.heard = {now, now, now, now, now, now, now};
  input.vehicle.stamp = now;
  input.vehicle.armed = true;
  input.vehicle.mode = VehicleMode::guided;
  input.vehicle.battery_share = 0.8;
  input.vehicle.height_m = 3;
  input.odometry.status = VehicleOdometryStatus::ok;
  input.odometry.T_odom_body.translation() = Eigen::Vector3d(1, 2, 3);
  input.odometry.velocity = input.odometry.angular_velocity = Eigen::Vector3d::Zero();
  input.odometry.covariance = 1e-4 * Matrix6d::Identity();
  input.place = {1, 2, 3};
  input.setpoint = Setpoint{};
  input.setpoint->position = {1, 2, 3};
  input.setpoint->velocity = input.setpoint->acceleration = Eigen::Vector3d::Zero();
  input.setpoint->yaw = input.setpoint->yaw_rate = 0;
  input.flying = true;
  input.planning_due = true;
  return input;
}

struct Row {
  std::string what;
  std::function<void(SafetyInput&, double)> spoil;
  SafetyAction action;  ///< at least, in flight
  double after_s = 0;
};

/// Every number that safety is given, component by component.
std::vector<Row> numbers() {
  std::vector<Row> rows = {
      {"battery_share", [](auto& in, double x) { in.vehicle.battery_share = x; },
       SafetyAction::return_home, SafetyConfig{}.battery.unknown_s + 0.1},
      {"setpoint.yaw", [](auto& in, double x) { in.setpoint->yaw = x; }, SafetyAction::hold},
      {"setpoint.yaw_rate", [](auto& in, double x) { in.setpoint->yaw_rate = x; },
       SafetyAction::hold}};
  for (int i = 0; i < 4; ++i) {
    rows.push_back({fmt::format("attitude {}", i),
                    [i](auto& in, double x) { in.vehicle.attitude.coeffs()[i] = x; },
                    SafetyAction::hold});
  }
  for (int i = 0; i < 3; ++i) {
    const auto add = [&](const char* what, SafetyAction action, auto spoil) {
      rows.push_back({fmt::format("{} {}", what, i), spoil, action});
    };
    add("place", SafetyAction::hold, [i](auto& in, double x) { in.place[i] = x; });
    add("setpoint.position", SafetyAction::hold,
        [i](auto& in, double x) { in.setpoint->position[i] = x; });
    add("setpoint.velocity", SafetyAction::hold,
        [i](auto& in, double x) { in.setpoint->velocity[i] = x; });
    add("setpoint.acceleration", SafetyAction::hold,
        [i](auto& in, double x) { in.setpoint->acceleration[i] = x; });
    add("odometry.velocity", SafetyAction::silence,
        [i](auto& in, double x) { in.odometry.velocity[i] = x; });
    add("odometry.angular_velocity", SafetyAction::silence,
        [i](auto& in, double x) { in.odometry.angular_velocity[i] = x; });
    for (int j = 0; j < 4; ++j) {
      add("odometry.T_odom_body", SafetyAction::silence,
          [i, j](auto& in, double x) { in.odometry.T_odom_body.matrix()(i, j) = x; });
    }
  }
  for (int i = 0; i < 6; ++i) {
    for (int j = 0; j < 6; ++j) {
      rows.push_back({fmt::format("covariance {} {}", i, j),
                      [i, j](auto& in, double x) { in.odometry.covariance(i, j) = x; },
                      SafetyAction::silence});
    }
  }
  return rows;
}

/// After 0.1 s of good flight, what is decided when a row has been spoilt for its time.
SafetyDecision decided(const Row& row, double value) {
  Safety safety(SafetyConfig{}, motion::Geofence(motion::GeofenceConfig{}));
  SafetyDecision decision;
  Time now = kNow;
  for (int i = 0; i < 5; ++i) {
    decision = safety.update(good(now += kStep));
    EXPECT_EQ(decision.action, SafetyAction::none) << decision.text;
  }
  for (const Time end = now + kStep + from_seconds(row.after_s); now < end;) {
    SafetyInput input = good(now += kStep);
    row.spoil(input, value);
    decision = safety.update(input);
  }
  return decision;
}

TEST(SafetyUnknown, ANumberThatIsNoneOrInfiniteIsNeverFineInFlight) {
  for (const Row& row : numbers()) {
    for (const double value : {double{NAN}, double{INFINITY}, -double{INFINITY}}) {
      const SafetyDecision decision = decided(row, value);
      EXPECT_GE(decision.action, row.action) << row.what << " = " << value;
      EXPECT_FALSE(decision.text.empty());
    }
  }
}

TEST(SafetyUnknown, NorOnTheGroundWhereThereIsNoSetpoint) {
  Safety safety(SafetyConfig{}, motion::Geofence(motion::GeofenceConfig{}));
  for (const Row& row : numbers()) {
    if (row.what.starts_with("setpoint")) continue;
    for (const double value : {double{NAN}, double{INFINITY}, -double{INFINITY}}) {
      SafetyInput input = good(kNow);
      row.spoil(input, value);
      input.flying = false;
      EXPECT_FALSE(safety.findings(input).empty()) << row.what << " = " << value;
    }
  }
}

TEST(SafetyUnknown, AStampOfTheFutureOrOfNeverIsSilence) {
  Time Heard::*const stamps[] = {&Heard::vehicle, &Heard::lidar,     &Heard::odometry,
                                 &Heard::verdict, &Heard::occupancy, &Heard::mapping,
                                 &Heard::planning};
  const Time wrong[] = {0, kNow + 20 * kNanosecondsPerSecond, std::numeric_limits<Time>::max(),
                        std::numeric_limits<Time>::min(), -1};
  for (const auto stamp : stamps) {
    for (const Time value : wrong) {
      Safety safety(SafetyConfig{}, motion::Geofence(motion::GeofenceConfig{}));
      SafetyInput input = good(kNow);
      input.heard.*stamp = value;
      EXPECT_GE(safety.update(input).action, SafetyAction::hold) << value;
    }
  }
}

TEST(SafetyUnknown, AFaultOfTheVehicleThatNobodyKnowsHolds) {
  Safety safety(SafetyConfig{}, motion::Geofence(motion::GeofenceConfig{}));
  SafetyInput input = good(kNow);
  input.vehicle.faults = kAllVehicleFaults + 1;
  EXPECT_EQ(safety.update(input).cause, Cause::vehicle_unclear);
}

TEST(SafetyUnknown, AChargeThatIsNoShareIsUnknown) {
  Safety safety(SafetyConfig{}, motion::Geofence(motion::GeofenceConfig{}));
  for (const double share : {-0.5, 1.5, 80.0}) {
    SafetyInput input = good(kNow);
    input.flying = false;
    input.vehicle.battery_share = share;
    EXPECT_FALSE(safety.findings(input).empty()) << share;
  }
}

// No limit reads the barometer's height: the odometry's is read, which is silence when it is none.
TEST(SafetyUnknown, TheBarometersHeightIsNotRead) {
  const Row row{"height_m", [](auto& in, double x) { in.vehicle.height_m = x; },
                SafetyAction::none};
  EXPECT_EQ(decided(row, NAN).action, SafetyAction::none);
}

}  // namespace
}  // namespace saker::autonomy
