#include "saker/active/tour/vehicle_track.h"

#include <gtest/gtest.h>

namespace saker::active {
namespace {

constexpr Time kSecond = kNanosecondsPerSecond;

SE3 at(double x) {
  SE3 T = SE3::Identity();
  T.translation() = Eigen::Vector3d(x, 0, 3);
  return T;
}

TEST(VehicleTrack, KnowsTimeAndWayBetweenDecisions) {
  VehicleTrack track;
  EXPECT_TRUE(track.advance(5 * kSecond, at(2)));
  EXPECT_EQ(track.elapsed_s(), 0);
  EXPECT_EQ(track.flown_m(), 0) << "the way to the first decision is none";
  EXPECT_TRUE(track.advance(6 * kSecond, at(5)));
  EXPECT_NEAR(track.elapsed_s(), 1, 1e-9);
  EXPECT_NEAR(track.flown_m(), 3, 1e-9);
  EXPECT_FALSE(track.stands());
  EXPECT_EQ(track.stamp(), 6 * kSecond);
}

TEST(VehicleTrack, SlowerThanAHandsbreadthASecondIsStanding) {
  VehicleTrack track;
  EXPECT_TRUE(track.advance(kSecond, at(0)));
  EXPECT_FALSE(track.stands()) << "nothing is known of the time before";
  EXPECT_TRUE(track.advance(2 * kSecond, at(0.19)));
  EXPECT_TRUE(track.stands());
  EXPECT_TRUE(track.advance(3 * kSecond, at(0.40)));
  EXPECT_FALSE(track.stands());
}

TEST(VehicleTrack, AGapCountsForTwoSecondsAtMost) {
  VehicleTrack track;
  EXPECT_TRUE(track.advance(kSecond, at(0)));
  EXPECT_TRUE(track.advance(100 * kSecond, at(0)));
  EXPECT_EQ(track.elapsed_s(), 2);
}

TEST(VehicleTrack, RefusesWhatIsNotFiniteOrNotNewerAndChangesNothing) {
  VehicleTrack track;
  EXPECT_FALSE(track.advance(kSecond, at(NAN)));
  EXPECT_TRUE(track.advance(kSecond, at(1)));
  EXPECT_FALSE(track.advance(kSecond, at(9)));
  EXPECT_FALSE(track.advance(2 * kSecond, at(NAN)));
  EXPECT_EQ(track.position().x(), 1);
  EXPECT_EQ(track.flown_m(), 0);
}

}  // namespace
}  // namespace saker::active
