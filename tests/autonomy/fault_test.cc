#include <gtest/gtest.h>

#include <algorithm>

#include "faulty_flight.h"

// What goes wrong in flight, in lockstep: at rest or landing within two seconds, nothing is hit,
// and the cause is said. tests/flight/fault_process_test.py does the same with processes.
namespace saker::autonomy {
namespace {

using simulation::ScenarioEvent;
using simulation::ScenarioEventKind;

constexpr double kSettled_s = 2;
constexpr double kLongEnough_s = 3;
constexpr double kRecovers_s = 4;     // safety.recover_s, and a moment
constexpr double kFliesAgain_s = 12;  // replanned, sped up
constexpr double kGap_s = 0.55;       // longer than safety.lidar_s
constexpr double kBlow_s = 0.06;      // 0.9 m/s are lost
constexpr double kMission_s = 200;
constexpr double kReference_s = 30;  // of the flight without a fault
constexpr double kInTheWay_m = 0.5;  // from a wall's middle: well within its width

/// As soon as it flies fast.
std::vector<ScenarioEvent> on_the_way(ScenarioEventKind kind) {
  ScenarioEvent event;
  event.kind = kind;
  event.at_s = 0;
  event.from_speed_mps = FaultyFlight::kFast;
  return {event};
}

/// A wall, when the flight without it is fastest of all moments after which it comes to where the
/// wall will stand: it flies into it, and not round a corner before.
std::vector<ScenarioEvent> wall_in_the_way() {
  FaultyFlight without;
  without.go_on(kReference_s);
  const auto& rows = without.plant.rows;
  ScenarioEvent wall;
  double fastest = 0;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const Eigen::Vector2d velocity = rows[i].truth.velocity.head<2>();
    if (velocity.norm() <= fastest) continue;
    const Eigen::Vector2d at =
        rows[i].truth.T_world_body.translation().head<2>() + wall.ahead_m * velocity.normalized();
    const auto comes_there = [&](const RecordedPlant::Row& later) {
      return (later.truth.T_world_body.translation().head<2>() - at).norm() < kInTheWay_m;
    };
    if (std::none_of(rows.begin() + static_cast<std::ptrdiff_t>(i), rows.end(), comes_there)) {
      continue;
    }
    fastest = velocity.norm();
    wall.at_s = rows[i].truth.flight_time_s;
  }
  return {wall};
}

// Hazard: Stages and links | nothing reaches the flight controller any more | it levels and
//   descends on inertial unit and barometer | 2
TEST(Fault, WithoutTheExecutiveTheVehicleComesDownByItself) {
  FaultyFlight flight;
  ASSERT_TRUE(flight.fly_fast_into([&] { flight.plant.link = RecordedPlant::Link::deaf; }));
  flight.go_on(kLongEnough_s);
  EXPECT_LE(flight.settled_after(), kSettled_s);
  EXPECT_TRUE((flight.faults() & kNoOdometry) != 0);
  EXPECT_EQ(flight.collisions(), 0);
}

// Hazard: Stages and links | the collision checker dies | stops on the way, then lands | 2
TEST(Fault, WithoutTheCollisionCheckerItStops) {
  FaultyFlight flight;
  ASSERT_TRUE(flight.fly_fast_into([&] { flight.checker.die(); }));
  flight.go_on(kLongEnough_s);
  EXPECT_LE(flight.settled_after(), kSettled_s);
  EXPECT_LE(flight.said_after(Cause::checker_silent), kSettled_s);
  EXPECT_EQ(flight.collisions(), 0);
}

// Hazard: Stages and links | the collision checker begins again with an empty map | holds until
//   it has seen enough, then goes on | 2
TEST(Fault, ACheckerThatBeganAgainWithNothingIsFlownByAgain) {
  FaultyFlight flight;
  ASSERT_TRUE(flight.fly_fast_into([&] { flight.checker.die(); }));
  flight.go_on(kLongEnough_s);
  flight.checker.begin();
  flight.go_on(kRecovers_s);
  EXPECT_GE(flight.said_after(Cause::recovered), kLongEnough_s);
  EXPECT_EQ(flight.result().phase, MissionPhase::tour);
  EXPECT_TRUE(flight.flies_fast_again(kFliesAgain_s));
  EXPECT_EQ(flight.collisions(), 0);
}

// Hazard: Sensor | no scan for 0.55 s | stops, goes on when scans come again | 2
TEST(Fault, InALongGapOfScansItStopsAndThenFliesOn) {
  FaultyFlight flight;
  ASSERT_TRUE(flight.fly_fast_into([&] { flight.plant.link = RecordedPlant::Link::blind; }, kGap_s,
                                   [&] { flight.plant.link = RecordedPlant::Link::up; }));
  flight.go_on(kLongEnough_s);
  EXPECT_LE(flight.settled_after(), kSettled_s);
  EXPECT_LE(flight.said_after(Cause::lidar_silent), kSettled_s);
  EXPECT_TRUE(flight.flies_fast_again(kFliesAgain_s));
  EXPECT_EQ(flight.faults() & (kNoOdometry | kOdometryRejected), 0U);
  EXPECT_EQ(flight.collisions(), 0);
}

// Hazard: Stages and links | vehicle and sensor fall silent | the mission says so and ends | –
TEST(Fault, WithoutAPlantTheMissionSaysSoAndEnds) {
  FaultyFlight flight;
  ASSERT_TRUE(flight.fly_fast_into([&] { flight.plant.link = RecordedPlant::Link::gone; }));
  flight.go_on(2 * kLongEnough_s);
  EXPECT_LE(flight.said_after(Cause::lidar_silent), kSettled_s);
  EXPECT_GE(flight.said_after(Cause::vehicle_silent), MissionConfig{}.gone_s);
  EXPECT_EQ(flight.result().phase, MissionPhase::done);
  EXPECT_FALSE(flight.result().succeeded);
}

// Hazard: Sensor | the lidar stops for good | descends on the inertial unit | 2
TEST(Fault, WithoutTheLidarItLands) {
  FaultyFlight flight(on_the_way(ScenarioEventKind::lidar_stop));
  ASSERT_TRUE(flight.fly_into_event());
  flight.go_on(kLongEnough_s);
  EXPECT_LE(flight.settled_after(), kSettled_s);
  EXPECT_LE(flight.said_after(Cause::lidar_silent), kSettled_s);
  EXPECT_EQ(flight.collisions(), 0);
}

// Hazard: Odometry | the flight controller gets one pose again and again | it rejects odometry
//   and descends | 2
TEST(Fault, WithOdometryThatFreezesItLands) {
  FaultyFlight flight(on_the_way(ScenarioEventKind::odometry_freeze));
  ASSERT_TRUE(flight.fly_into_event());
  flight.go_on(kLongEnough_s);
  EXPECT_LE(flight.settled_after(), kSettled_s);
  EXPECT_LE(flight.said_after(Cause::vehicle_descends), kSettled_s);
  EXPECT_TRUE((flight.faults() & kOdometryRejected) != 0);
  EXPECT_EQ(flight.collisions(), 0);
}

// Hazard: Odometry | the flight controller gets no odometry | descends | 2
TEST(Fault, WithOdometryThatStopsItLands) {
  FaultyFlight flight(on_the_way(ScenarioEventKind::odometry_stop));
  ASSERT_TRUE(flight.fly_into_event());
  flight.go_on(kLongEnough_s);
  EXPECT_LE(flight.settled_after(), kSettled_s);
  EXPECT_LE(flight.said_after(Cause::vehicle_descends), kSettled_s);
  EXPECT_EQ(flight.collisions(), 0);
}

// Hazard: Surroundings | it touches something | lands where it is (`collision`) | 2
TEST(Fault, AContactThatItsAccelerometerFeelsLandsIt) {
  FaultyFlight flight;
  ASSERT_TRUE(flight.fly_fast_into(
      [&] {
        flight.plant.blow_mps2 = {-15, 0, 0};
      },
      kBlow_s, [&] { flight.plant.blow_mps2.setZero(); }));
  flight.go_on(kLongEnough_s);
  EXPECT_LE(flight.settled_after(), kSettled_s);
  EXPECT_LE(flight.said_after(Cause::collision), 0.2);
  EXPECT_EQ(flight.result().phase, MissionPhase::landing);
}

/// Twice the wind that it is made for, and home.
TEST(Fault, GustsAndTheTouchDownAreNoContact) {
  std::vector<ScenarioEvent> gusts;
  for (const double towards_deg : {0.0, 120.0, 240.0}) {
    ScenarioEvent gust;
    gust.kind = ScenarioEventKind::gust;
    gust.at_s = 6 + towards_deg / 60;
    gust.towards_deg = towards_deg;
    gusts.push_back(gust);
  }
  FaultyFlight flight(gusts);
  ASSERT_TRUE(flight.fly_into_event());
  flight.go_on(kMission_s);
  EXPECT_EQ(flight.result().phase, MissionPhase::done);
  EXPECT_TRUE(std::isnan(flight.said_after(Cause::collision)));
}

// Hazard: Surroundings | a wall stands in the way from one moment to the next | stops before it | 2
TEST(Fault, AnObstacleThatComesIntoTheWayStopsIt) {
  FaultyFlight flight(wall_in_the_way());
  ASSERT_TRUE(flight.fly_into_event());
  flight.go_on(kLongEnough_s);
  EXPECT_LE(flight.settled_after(), kSettled_s);
  EXPECT_LE(flight.said_after(Cause::stopped), kSettled_s);
  EXPECT_EQ(flight.collisions(), 0);
}

}  // namespace
}  // namespace saker::autonomy
