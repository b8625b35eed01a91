#include <gtest/gtest.h>

#include <algorithm>
#include <optional>

#include "kinematic_flight.h"

// What a mission makes of the place where it is to land.
namespace saker::autonomy {
namespace {

using occupancy::Cell;

constexpr double kLimit_s = 400;

class LandingMission : public testing::Test {
 protected:
  LandingMission() { block->stamp = 1; }

  void put(const Eigen::Vector3d& low, const Eigen::Vector3d& high, Cell cell = Cell::occupied) {
    fill(*block, low, high, cell);
  }
  /// People all around the place of take-off, while it is away.
  void gather() {
    for (double x = -6; x <= 6; x += 0.75) {
      for (double y = -6; y <= 6; y += 0.75) put({x, y, -0.25}, {x + 0.3, y + 0.3, 1.5});
    }
  }
  KinematicFlight& fly() {
    flight.emplace(std::vector<Eigen::Vector3d>{{8, 0, 0.8}}, block);
    return *flight;
  }
  [[nodiscard]] const MissionEvent* event(Cause cause) const {
    const auto it = std::ranges::find_if(flight->events,
                                         [&](const MissionEvent& e) { return e.cause == cause; });
    return it == flight->events.end() ? nullptr : &*it;
  }
  [[nodiscard]] Eigen::Vector2d landed_at() const {
    return flight->setpoints.back().position.head<2>();
  }

  std::shared_ptr<occupancy::OccupancyGrid> block =
      std::make_shared<occupancy::OccupancyGrid>(free_block(16));
  std::optional<KinematicFlight> flight;
};

TEST_F(LandingMission, LandsAtHomeWhereTheGroundIsLevelAndFree) {
  fly().run(kLimit_s);
  EXPECT_TRUE(flight->mission().succeeded());
  EXPECT_LT(landed_at().norm(), 0.5);
  EXPECT_EQ(event(Cause::landing_place), nullptr);
}

TEST_F(LandingMission, LandsBesideAPersonWhoStandsThere) {
  fly().run(20);  // it is on its tour, and comes back to somebody
  put({-0.3, -0.3, -0.25}, {0.3, 0.3, 1.6});
  flight->run(kLimit_s);
  EXPECT_TRUE(flight->mission().succeeded()) << to_string(flight->mission().outcome());
  EXPECT_GT(landed_at().norm(), 0.75);
  EXPECT_LT(landed_at().norm(), 4.5);
}

TEST_F(LandingMission, WhereNoPlaceIsFitItHoversSaysSoAndLandsOnTheLeastBadInTheEnd) {
  fly().run(20);
  gather();
  flight->run(kLimit_s);
  ASSERT_NE(event(Cause::landing_place), nullptr);
  EXPECT_NE(event(Cause::landing_place)->text.find("hovers"), std::string::npos);
  EXPECT_TRUE(flight->mission().done());
  EXPECT_EQ(flight->mission().outcome(), Cause::landing_place);
  const auto landing = std::ranges::find_if(
      flight->events, [](const MissionEvent& e) { return e.to == MissionPhase::landing; });
  EXPECT_GE(to_seconds(landing->stamp - event(Cause::landing_place)->stamp),
            MissionConfig{}.landing_wait_s);
  EXPECT_NE(landing->text.find("lands all the same"), std::string::npos) << landing->text;
}

TEST_F(LandingMission, AnEmptyBatteryLandsAtOnceAndSaysOnWhat) {
  fly().run(20);
  gather();
  flight->battery = [this](double share) {
    return event(Cause::landing_place) != nullptr ? 0.1 : share;
  };
  flight->run(kLimit_s);
  const MissionEvent* empty = event(Cause::battery_empty);
  ASSERT_NE(empty, nullptr);
  EXPECT_EQ(empty->to, MissionPhase::landing);
  EXPECT_NE(empty->text.find("lands all the same: not fit"), std::string::npos) << empty->text;
  EXPECT_LT(to_seconds(empty->stamp - event(Cause::landing_place)->stamp), 1);
}

}  // namespace
}  // namespace saker::autonomy
