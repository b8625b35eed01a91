#include "saker/autonomy/planning.h"

#include <gtest/gtest.h>

#include <numbers>

#include "kinematic_flight.h"
#include "saker/core/error.h"

namespace saker::autonomy {
namespace {

using occupancy::Cell;

std::shared_ptr<const occupancy::OccupancyGrid> shared(occupancy::OccupancyGrid grid) {
  return std::make_shared<const occupancy::OccupancyGrid>(std::move(grid));
}

int count(const KinematicFlight& flight, PlanningStatus status) {
  int n = 0;
  for (const PlanningReport& report : flight.reports) n += report.status == status;
  return n;
}

TEST(Planning, VisitsEveryTargetComesHomeAndLands) {
  KinematicFlight flight({{8, 6, 0.5}, {-8, 6, 0.5}, {6, -8, 0.5}}, shared(free_block(20)));
  const double took_s = flight.run(600);
  EXPECT_TRUE(flight.mission().succeeded()) << to_string(flight.mission().outcome());
  for (const active::Target& target : flight.targets()) {
    EXPECT_EQ(target.status, active::TargetStatus::visited) << target.reason;
  }
  EXPECT_LT(took_s, 240);
  EXPECT_LT(flight.largest_step_m, 0.06);  // 2.5 m/s at 50 Hz: no jump from one commit to the next
  ASSERT_FALSE(flight.setpoints.empty());
  EXPECT_LT(flight.setpoints.back().position.head<2>().norm(), 2);
}

TEST(Planning, ProposesNothingWhileWhatIsCommittedLeadsThere) {
  KinematicFlight flight({{8, 6, 0.5}}, shared(free_block(20)));
  (void)flight.run(600);
  int commits = 0;
  for (std::size_t i = 1; i < flight.reports.size(); ++i) {
    commits += flight.reports[i].target != flight.reports[i - 1].target;
  }
  EXPECT_LE(commits, 4);
}

/// The take-off place in a closed room: no target can be reached, home can.
// Hazard: Surroundings | nothing can be reached | returns, or lands where it is
//   (`nothing_reachable`, `home_unreachable`) | –
TEST(Planning, EndsWhereNothingIsReachable) {
  occupancy::OccupancyGrid grid = free_block(12);
  fill(grid, {-4, -4, -1}, {4, 4, 8}, Cell::occupied);
  fill(grid, {-3, -3, 0}, {3, 3, 7}, Cell::free);
  KinematicFlight flight({{14, 10, 0.5}}, shared(grid));
  const double took_s = flight.run(1200);
  EXPECT_TRUE(flight.mission().done());
  EXPECT_LT(took_s, 300);
  for (const active::Target& target : flight.targets()) {
    EXPECT_EQ(target.status, active::TargetStatus::unreachable);
    EXPECT_FALSE(target.reason.empty());
  }
}

/// Nothing was ever seen: even the first step is refused.
TEST(Planning, EndsWhereNothingIsKnown) {
  occupancy::OccupancyGrid grid = free_block(12);
  fill(grid, {-12, -12, -1}, {12, 12, 8}, Cell::unknown);
  KinematicFlight flight({{14, 10, 0.5}, {-14, 10, 0.5}}, shared(grid));
  EXPECT_LT(flight.run(1200), 300);
  EXPECT_TRUE(flight.mission().done());
  EXPECT_GT(count(flight, PlanningStatus::gave_up) + count(flight, PlanningStatus::refused) +
                count(flight, PlanningStatus::nothing_reachable),
            0);
}

TEST(Planning, EndsWithoutAnOccupancyBlock) {
  KinematicFlight flight({{14, 10, 0.5}}, nullptr);
  EXPECT_LT(flight.run(1200), 300);
  EXPECT_TRUE(flight.mission().done());
  EXPECT_FALSE(flight.mission().succeeded());
}

/// The checker finds every trajectory blocked where it begins: planning and checker disagree.
TEST(Planning, EndsWhenNoTrajectoryIsEverClear) {
  KinematicFlight flight({{8, 6, 0.5}}, shared(free_block(14)));
  flight.judge = [](motion::Verdict& verdict) {
    verdict.clear = false;
    verdict.clear_until = verdict.stamp;
  };
  EXPECT_LT(flight.run(2400), 600);
  EXPECT_TRUE(flight.mission().done());
}

bool said(const KinematicFlight& flight, Cause cause) {
  return std::any_of(flight.events.begin(), flight.events.end(),
                     [cause](const MissionEvent& event) { return event.cause == cause; });
}

// Hazard: Surroundings | something stands where it is to land, the ground is steep, returns nothing
//   (water) or was not seen | moves up to 4 m to a fit place, else hovers 30 s; says so
//   (`place_unfit`) | –
TEST(Planning, LandsBesideWhatCameToItsPlaceMeanwhile) {
  KinematicFlight flight({{8, 6, 0.5}}, shared(free_block(20)));
  ASSERT_TRUE(flight.run_to(MissionPhase::return_home, 300));
  occupancy::OccupancyGrid parked = free_block(20);
  fill(parked, {-1, -1, -0.25}, {1, 1, 1.4}, Cell::occupied);
  flight.see(shared(parked));
  (void)flight.run(120);
  EXPECT_TRUE(flight.mission().succeeded()) << to_string(flight.mission().outcome());
  EXPECT_GT(flight.place().head<2>().cwiseAbs().maxCoeff(), 1.7);
  EXPECT_LT(flight.place().head<2>().norm(), 5);
}

TEST(Planning, HoversWhereNothingIsFitAndThenLandsAllTheSame) {
  KinematicFlight flight({{8, 6, 0.5}}, shared(free_block(20)));
  ASSERT_TRUE(flight.run_to(MissionPhase::return_home, 300));
  occupancy::OccupancyGrid crowd = free_block(20);
  for (int i = -8; i <= 8; ++i) {
    for (int k = -8; k <= 8; ++k) {
      const Eigen::Vector3d foot(i, k, -0.25);
      fill(crowd, foot, foot + Eigen::Vector3d(0.4, 0.4, 1.8), Cell::occupied);
    }
  }
  flight.see(shared(crowd));
  const double took_s = flight.run(200);
  EXPECT_GT(took_s, MissionConfig{}.place_s);
  EXPECT_EQ(flight.mission().outcome(), Cause::place_unfit);
  EXPECT_TRUE(said(flight, Cause::place_unfit));
}

active::ActiveConfig with_lidar_turned(double degrees, const Eigen::Vector3d& axis) {
  active::ActiveConfig active;
  active.policy = active::PolicyName::visit;
  active.view.R_body_lidar =
      Eigen::AngleAxisd(degrees * std::numbers::pi / 180, axis).toRotationMatrix();
  return active;
}

/// Hovers at 3 m, nose to x, with a vehicle 24 m to its left; on that side nothing is known.
std::optional<Proposal> proposed(const active::ActiveConfig& active) {
  objects::MapObject car;
  car.class_id = objects::ClassTable{}.find("vehicle");
  objects::Cuboid cuboid;
  cuboid.pose.translation() = Eigen::Vector3d(0, 24, 0.8);
  car.model = cuboid;
  objects::ObjectMap prior;
  prior.objects = {car};
  Planning planning({}, active, {}, objects::ClassTable{}, prior, 3);
  occupancy::OccupancyGrid grid = free_block(20);
  fill(grid, {-20, 1, -1}, {20, 20, 8}, Cell::unknown);
  PlanningInput input;
  input.now = kNanosecondsPerSecond;
  input.order = PlanningOrder::tour;
  input.odometry.T_odom_body.translation().z() = 3;
  input.grid = shared(std::move(grid));
  motion::MotionState here;
  here.position = {0, 0, 3};
  here.velocity = here.acceleration = Eigen::Vector3d::Zero();
  here.yaw = here.yaw_rate = 0;
  input.committed = std::make_shared<const motion::Trajectory>(resting(input.now, here));
  return planning.step(input, core::Budget::iterations(1000)).proposal;
}

TEST(Planning, OfALidarOnItsSideTurnsToAWayThatItHasNotSeen) {
  const auto proposal = proposed(with_lidar_turned(90, Eigen::Vector3d::UnitX()));
  ASSERT_TRUE(proposal);
  const motion::MotionState& end = proposal->trajectory.states.back();
  EXPECT_LT((end.position - Eigen::Vector3d(0, 0, 3)).norm(), 0.1);
  EXPECT_NEAR(end.yaw, std::numbers::pi / 2, 0.7) << "to a viewpoint of the vehicle";
}

TEST(Planning, OfALevelLidarDoesNotTurnOnTheSpot) {
  const auto proposal = proposed(with_lidar_turned(0, Eigen::Vector3d::UnitY()));
  if (proposal) {
    EXPECT_GT((proposal->trajectory.states.back().position - Eigen::Vector3d(0, 0, 3)).norm(), 1);
  }
}

TEST(Planning, RefusesALidarThatDoesNotSeeWhereItFlies) {
  const auto active = with_lidar_turned(45, Eigen::Vector3d::UnitY());
  EXPECT_THROW(Planning({}, active, {}, objects::ClassTable{}, {}, 3), Error);
}

TEST(Planning, TwoFlightsAreTheSame) {
  const auto grid = shared(free_block(20));
  KinematicFlight a({{8, 6, 0.5}, {-8, 6, 0.5}}, grid), b({{8, 6, 0.5}, {-8, 6, 0.5}}, grid);
  EXPECT_EQ(a.run(600), b.run(600));
  ASSERT_EQ(a.setpoints.size(), b.setpoints.size());
  for (std::size_t i = 0; i < a.setpoints.size(); ++i) {
    ASSERT_EQ(a.setpoints[i].position, b.setpoints[i].position);
  }
}

}  // namespace
}  // namespace saker::autonomy
