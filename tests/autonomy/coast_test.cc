#include <gtest/gtest.h>

#include "faulty_flight.h"

// The lidar is covered in flight while its inertial unit goes on: packets come, without a return.
namespace saker::autonomy {
namespace {

constexpr double kAfter_s = 4;  // to settle in odometry, and hold out safety.recover_s
constexpr double kFliesAgain_s = 16;
constexpr double kMostOff_m = 0.5;  // of the pose, at the end of the cover

/// \return the flight, `after_s` after the end of the cover
std::unique_ptr<FaultyFlight> covered_for(double seconds, double after_s) {
  auto flight = std::make_unique<FaultyFlight>();
  const bool covered =
      flight->fly_fast_into([&flight] { flight->plant.link = RecordedPlant::Link::covered; },
                            seconds, [&flight] { flight->plant.link = RecordedPlant::Link::up; });
  EXPECT_TRUE(covered);
  flight->go_on(seconds + after_s);
  return flight;
}

class Covered : public ::testing::TestWithParam<double> {};

TEST_P(Covered, ItHoldsOnItsInertialUnitAndThenFliesOn) {
  const auto flight = covered_for(GetParam(), kAfter_s);
  EXPECT_EQ(flight->collisions(), 0);
  EXPECT_LE(flight->settled_after(), 2);
  EXPECT_LT(flight->most_off_m(), kMostOff_m);
  EXPECT_TRUE(std::isnan(flight->said_after(Cause::odometry_lost)));
  EXPECT_EQ(flight->faults() & (kNoOdometry | kOdometryRejected), 0U);
  EXPECT_TRUE(flight->flies_fast_again(kFliesAgain_s));
}

INSTANTIATE_TEST_SUITE_P(ForSoLong, Covered, ::testing::Values(1.0, 2.0, 3.0));

TEST(CoveredForLong, ItComesDownWhenTheStatedCovarianceAllowsNoMore) {
  const auto flight = covered_for(60, -40);
  EXPECT_EQ(flight->collisions(), 0);
  EXPECT_LE(flight->settled_after(), 2);
  EXPECT_GT(flight->said_after(Cause::odometry_lost), 2);
  EXPECT_LT(flight->said_after(Cause::odometry_lost), 6.5);
  EXPECT_FALSE(flight->plant.rows.back().state.armed);
  EXPECT_FALSE(flight->result().succeeded);
}

}  // namespace
}  // namespace saker::autonomy
