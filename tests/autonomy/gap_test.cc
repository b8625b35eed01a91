#include <gtest/gtest.h>

#include "faulty_flight.h"

// A gap of scans at speed costs a stop at most: the pose is the inertial unit's for so long, and
// the flight controller believes the scans that come after it.
namespace saker::autonomy {
namespace {

constexpr double kFast_mps = 2.3;  // 2.5 is the limit
constexpr double kHome_s = 120;

class GapOfScans : public testing::TestWithParam<double> {};

TEST_P(GapOfScans, AtSpeedTheMissionGoesOnAndEndsAtHome) {
  FaultyFlight flight;
  ASSERT_TRUE(flight.fly_into_gap_of_scans(kFast_mps, GetParam()));
  flight.go_on(kHome_s);
  EXPECT_EQ(flight.faults() & (kNoOdometry | kOdometryRejected), 0U);
  EXPECT_EQ(flight.result().outcome, Cause::landed);
  EXPECT_TRUE(flight.result().succeeded);
  EXPECT_EQ(flight.collisions(), 0);
}

INSTANTIATE_TEST_SUITE_P(Seconds, GapOfScans, testing::Values(0.2, 0.5, 3.0));

// Hazard: Odometry | the lidar is covered for 3 s | holds on the inertial unit, goes on | 2
TEST(CoveredLidar, For3SecondsIsAHoldAndTheMissionEndsAtHome) {
  FaultyFlight flight;
  ASSERT_TRUE(flight.fly_fast_into([&] { flight.plant.link = RecordedPlant::Link::covered; }, 3,
                                   [&] { flight.plant.link = RecordedPlant::Link::up; }));
  flight.go_on(kHome_s);
  EXPECT_LE(flight.settled_after(), 2);
  EXPECT_TRUE(std::isnan(flight.said_after(Cause::odometry_lost)));
  EXPECT_TRUE(flight.result().succeeded);
  EXPECT_EQ(flight.collisions(), 0);
}

// Hazard: Odometry | the lidar is covered for good | holds while the inertial unit knows the place,
//   then the flight controller descends (`odometry_lost`) | 2
TEST(CoveredLidar, ForGoodEndsInADescentBeforeThePlaceIsAGuess) {
  FaultyFlight flight;
  ASSERT_TRUE(flight.fly_fast_into([&] { flight.plant.link = RecordedPlant::Link::covered; }));
  flight.go_on(30);
  EXPECT_LE(flight.settled_after(), 2);
  EXPECT_GT(flight.said_after(Cause::odometry_lost), SafetyConfig{}.odometry_lost_s + 1);
  EXPECT_LE(flight.said_after(Cause::odometry_lost), BodyPoseConfig{}.coast_s + 0.2);
  EXPECT_EQ(flight.result().phase, MissionPhase::done);
  EXPECT_EQ(flight.collisions(), 0);
}

}  // namespace
}  // namespace saker::autonomy
