#include <gtest/gtest.h>

#include "saker/core/error.h"
#include "tools/saker/flight_report/flight_figures.h"

namespace saker::tools {
namespace {

bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

objects::MapObject vehicle(int id, double x, double length, const objects::ClassTable& table) {
  objects::MapObject object;
  object.id = id;
  object.class_id = table.find("vehicle");
  object.model = objects::Cuboid{SE3(Eigen::Translation3d(x, 0, 0.7)), {length, 1.8, 1.5}};
  return object;
}

StampedPose at(double t, double x) { return {t, SE3(Eigen::Translation3d(x, 0, 0))}; }

/// Two targets; the first one is mapped 10 cm too long, the second one not. The trajectory is off
/// by 20 cm half of the time.
class FlightFigures : public testing::Test {
 protected:
  FlightFigures() {
    flight_.truth.map.objects = {vehicle(4, 0, 4.5, table_), vehicle(7, 20, 4.2, table_)};
    flight_.prior.objects = flight_.truth.map.objects;
    flight_.map.objects = {vehicle(0, 0.3, 4.6, table_)};
    flight_.truth.trajectory = {at(1, 0), at(1.1, 1), at(1.2, 2), at(1.3, 3)};
    flight_.trajectory = {at(1, 0), at(1.1, 1), at(1.2, 2.2), at(1.3, 3.2)};
    flight_.simulator = {{"collisions", 0}, {"min_clearance_m", 0.6}, {"flight_time_s", 90.0},
                         {"path_m", 120.0}, {"landed", true},         {"seed", 1},
                         {"behind_s", 0.0}, {"wall_s", 100.0},        {"cpu_s", 25.0}};
    flight_.loops = {{"wall_s", 50.0},
                     {"cpu_s", 20.0},
                     {"loops",
                      {{{"name", "guidance"},
                        {"runs", 2500},
                        {"late", 1},
                        {"worst_late_ms", 6.5},
                        {"cpu_s", 0.5}}}}};
  }

  Json figures() { return flight_figures(flight_, table_); }

  objects::ClassTable table_;
  FlownMission flight_;
};

TEST_F(FlightFigures, TargetsAreThoseOfThePriorMapAndTheMissedOnesAreNamed) {
  const Json result = figures();
  EXPECT_EQ(result["targets"], 2);
  EXPECT_EQ(result["found"], 1);
  EXPECT_EQ(result["missed"], Json({7}));
  EXPECT_NEAR(result["mae_m"].get<double>(), 0.05, 1e-9);  // 0.1 of length, 0 of width
  EXPECT_EQ(result["errors"][0]["true_length_m"], 4.5);
}

TEST_F(FlightFigures, VehiclesBesideTheTargetsDoNotCount) {
  flight_.prior.objects.pop_back();
  const Json result = figures();
  EXPECT_EQ(result["targets"], 1);
  EXPECT_TRUE(result["missed"].empty());
}

TEST_F(FlightFigures, TheTrajectoryIsComparedAtEqualStampsWithoutAlignment) {
  EXPECT_NEAR(figures()["trajectory_error_m"].get<double>(), std::sqrt(0.04 / 2), 1e-6);
  EXPECT_NEAR(figures()["trajectory_max_m"].get<double>(), 0.2, 1e-6);
}

TEST_F(FlightFigures, ProcessorTimeIsASecondOfFlight) {
  EXPECT_DOUBLE_EQ(figures()["cpu"].get<double>(), 0.4);
  EXPECT_DOUBLE_EQ(figures()["simulator_cpu"].get<double>(), 0.25);
}

TEST_F(FlightFigures, ProcessorTimeOfTheCollisionCheckerIsSaidWhereItIsKnown) {
  EXPECT_TRUE(figures()["checker_cpu"].is_null());
  EXPECT_EQ(flight_text(figures(), {}).find("collision checker"), std::string::npos);
  flight_.checker = {{"wall_s", 50.0}, {"cpu_s", 15.0}};
  EXPECT_DOUBLE_EQ(figures()["checker_cpu"].get<double>(), 0.3);
  EXPECT_NE(flight_text(figures(), {}).find("collision checker: 0.30"), std::string::npos);
}

TEST_F(FlightFigures, AFlightThatFoundAllWithinTheLimitsDoesNotFallShort) {
  flight_.map.objects.push_back(vehicle(1, 20, 4.2, table_));
  EXPECT_TRUE(shortfalls_of(figures(), {}).empty());
}

TEST_F(FlightFigures, EveryShortfallIsNamed) {
  flight_.simulator["collisions"] = 1;
  flight_.simulator["landed"] = false;
  const auto lines = shortfalls_of(figures(), {.size_mae_m = 0.01, .trajectory_error_m = 0.1});
  ASSERT_EQ(lines.size(), 5u);
  EXPECT_EQ(lines[0], "targets not found: [7]");
  EXPECT_EQ(lines[1], "not landed");
  EXPECT_TRUE(contains(lines[2], "MAE"));
  EXPECT_TRUE(contains(lines[3], "trajectory"));
  EXPECT_TRUE(contains(lines[4], "collisions: 1"));
}

TEST_F(FlightFigures, AnEmptyMapHasNoErrorsAndFallsShort) {
  flight_.map.objects.clear();
  flight_.trajectory.clear();
  EXPECT_TRUE(figures()["mae_m"].is_null());
  EXPECT_TRUE(figures()["trajectory_error_m"].is_null());
  EXPECT_EQ(shortfalls_of(figures(), {}).size(), 3u);
}

TEST_F(FlightFigures, TheTextShowsTargetsLoopsAndShortfalls) {
  const Json result = figures();
  const std::string text = flight_text(result, shortfalls_of(result, {}));
  EXPECT_TRUE(contains(text, "1 of 2 targets found"));
  EXPECT_TRUE(contains(text, "guidance"));
  EXPECT_TRUE(contains(text, "falls short: targets not found: [7]"));
}

TEST_F(FlightFigures, AMissingKeyIsNamed) {
  flight_.simulator.erase("collisions");
  try {
    (void)figures();
    FAIL() << "expected an Error";
  } catch (const Error& error) {
    EXPECT_TRUE(contains(error.what(), "collisions"));
  }
}

}  // namespace
}  // namespace saker::tools
