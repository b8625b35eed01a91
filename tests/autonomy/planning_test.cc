#include "autonomy/planning.h"

#include <gtest/gtest.h>

#include "kinematic_flight.h"

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
