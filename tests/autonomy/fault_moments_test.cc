#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <iostream>

#include "faulty_flight.h"

// Whatever fails, and whenever: at rest or landing within two seconds, and it stays so. The moments
// are those of the same flight without a fault, to the byte, at which it would hurt most. Prints a
// table.
namespace saker::autonomy {
namespace {

using simulation::ScenarioEvent;
using simulation::ScenarioEventKind;

constexpr double kSettled_s = 2;
constexpr double kWatched_s = 5;
constexpr double kReference_s = 34;
constexpr double kLow_m = 0.7;       // near the ground: in the climb of the take-off
constexpr double kHigh_m = 2.5;      // on the way
constexpr std::size_t kAround = 10;  // steps of 10 ms, for accelerations

struct Moment {
  const char* name;
  double flown_s = NAN;
  double most = -INFINITY;  // of what the moment is the greatest of

  void take(double value, double at_s) {
    if (value > most) most = value, flown_s = at_s;
  }
};

using Moments = std::array<Moment, 5>;

double height(const RecordedPlant::Row& row) { return row.truth.T_world_body.translation().z(); }

Moments moments_of(const std::vector<RecordedPlant::Row>& rows) {
  Moments moments = {
      {{"accelerating"}, {"cruising"}, {"turning"}, {"braking"}, {"near the ground"}}};
  auto& [accelerating, cruising, turning, braking, low] = moments;
  for (std::size_t i = kAround; i + kAround < rows.size(); ++i) {
    const simulation::VehicleTruth& truth = rows[i].truth;
    const double at_s = truth.flight_time_s;
    if (truth.has_flown && height(rows[i]) > kLow_m) low.take(0, at_s);
    const double speed = truth.velocity.norm();
    if (height(rows[i]) < kHigh_m || speed < FaultyFlight::kFast) continue;
    const auto &before = rows[i - kAround].truth, &after = rows[i + kAround].truth;
    const Eigen::Vector3d acceleration =
        (after.velocity - before.velocity) / to_seconds(after.stamp - before.stamp);
    const double along = acceleration.dot(truth.velocity) / speed;
    accelerating.take(along, at_s);
    braking.take(-along, at_s);
    cruising.take(speed, at_s);
    turning.take((acceleration - along / speed * truth.velocity).norm(), at_s);
  }
  return moments;
}

const Moments& moments() {
  static const Moments found = [] {
    FaultyFlight flight;
    flight.go_on(kReference_s);
    return moments_of(flight.plant.rows);
  }();
  return found;
}

struct Fault {
  const char* name;
  std::optional<ScenarioEventKind> event;  // else the test's own
  RecordedPlant::Link link = RecordedPlant::Link::up;
  bool checker_dies = false;
  bool goes_on = false;  // it only stops for a while, then finds a way around
};

std::vector<Fault> faults() {
  return {
      {"executive killed", {}, RecordedPlant::Link::deaf},
      {"collision checker killed", {}, RecordedPlant::Link::up, true},
      {"lidar stops", ScenarioEventKind::lidar_stop},
      {"odometry freezes", ScenarioEventKind::odometry_freeze},
      {"odometry stops", ScenarioEventKind::odometry_stop},
      {"obstacle in the way", ScenarioEventKind::obstacle, RecordedPlant::Link::up, false, true}};
}

std::vector<ScenarioEvent> events_of(const Fault& fault, double flown_s) {
  if (!fault.event) return {};
  ScenarioEvent event;
  event.kind = *fault.event;
  event.at_s = flown_s;
  return {event};
}

class FaultAtMoments : public testing::TestWithParam<std::size_t> {};

TEST_P(FaultAtMoments, AtRestOrLandingWithinTwoSecondsAndStaysSo) {
  const Fault fault = faults()[GetParam()];
  std::string row = fmt::format("| {} |", fault.name);
  for (const Moment& moment : moments()) {
    if (fault.goes_on && &moment == &moments().back()) {  // nothing is in the way of a climb
      row += " – |";
      continue;
    }
    SCOPED_TRACE(fmt::format("{} while {} ({:.2f} s)", fault.name, moment.name, moment.flown_s));
    FaultyFlight flight(events_of(fault, moment.flown_s));
    const bool begun = flight.fly_into_moment(moment.flown_s, [&] {
      flight.plant.link = fault.link;
      if (fault.checker_dies) flight.checker.die();
    });
    ASSERT_TRUE(begun);
    flight.go_on(kWatched_s);
    const double settled = fault.goes_on ? flight.settled_after() : flight.settled_for_good_after();
    EXPECT_LE(settled, kSettled_s);
    EXPECT_EQ(flight.collisions(), 0);
    row += fmt::format(" {:.2f} |", settled);
  }
  std::cout << row << std::endl;
}

INSTANTIATE_TEST_SUITE_P(All, FaultAtMoments, testing::Range<std::size_t>(0, faults().size()));

}  // namespace
}  // namespace saker::autonomy
