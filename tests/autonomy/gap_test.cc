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

INSTANTIATE_TEST_SUITE_P(Seconds, GapOfScans, testing::Values(0.2, 0.5));

}  // namespace
}  // namespace saker::autonomy
