#include "tools/saker/replay/shortfalls.h"

#include <gtest/gtest.h>

namespace saker::tools {
namespace {

using odometry::OdometryReason;
using odometry::OdometryStatus;

autonomy::LockstepResult run_of(int scans, int lost, OdometryReason reason, int objects) {
  autonomy::LockstepResult result;
  result.scans.resize(static_cast<std::size_t>(scans));
  for (int i = 0; i < scans; ++i) {
    autonomy::ScanRecord& scan = result.scans[static_cast<std::size_t>(i)];
    scan.stamp = from_seconds(0.1 * i);
    scan.status = i < lost ? OdometryStatus::predicted : OdometryStatus::ok;
    scan.reason = i < lost ? reason : OdometryReason::none;
  }
  result.map.objects.resize(static_cast<std::size_t>(objects));
  return result;
}

TEST(Shortfalls, AWholeRunHasNone) {
  EXPECT_TRUE(shortfalls(run_of(100, 0, OdometryReason::none, 3), 40).empty());
  EXPECT_TRUE(shortfalls(run_of(100, 0, OdometryReason::none, 0), 0).empty());
}

TEST(Shortfalls, MoreThanATenthOfTheScansNotRegisteredIsOne) {
  EXPECT_TRUE(shortfalls(run_of(100, 10, OdometryReason::no_fit, 1), 1).empty());
  const auto lines = shortfalls(run_of(100, 11, OdometryReason::no_fit, 1), 1);
  ASSERT_EQ(lines.size(), 1U);
  EXPECT_EQ(lines[0].find("11 of 100 scans were not registered"), 0U);
}

/// Nothing held the pose in the scans from the one to the other.
autonomy::LockstepResult open_run(std::size_t from, std::size_t to) {
  autonomy::LockstepResult result = run_of(120, 0, OdometryReason::none, 1);
  for (std::size_t i = from; i < to; ++i) {
    result.scans[i].status = OdometryStatus::open;
    result.scans[i].reason = OdometryReason::not_held;
  }
  return result;
}

TEST(Shortfalls, MoreThanATenthOfTheScansThatNothingHeldIsOne) {
  EXPECT_TRUE(shortfalls(open_run(50, 60), 1).empty());
  const auto lines = shortfalls(open_run(50, 61), 1);
  ASSERT_EQ(lines.size(), 1U);
  EXPECT_EQ(lines[0].find("in 11 of 120 scans nothing in sight held the pose"), 0U);
}

TEST(Shortfalls, ANewMapMayHoldLittleForTwoSeconds) {
  EXPECT_TRUE(shortfalls(open_run(0, 20), 1).empty());
  EXPECT_FALSE(shortfalls(open_run(15, 40), 1).empty());
}

TEST(Shortfalls, TimeThatDoesNotGoOnIsOne) {
  const auto lines = shortfalls(run_of(100, 1, OdometryReason::not_newer, 1), 1);
  ASSERT_EQ(lines.size(), 1U);
  EXPECT_EQ(lines[0].find("time did not go on in 1 scans"), 0U);
}

TEST(Shortfalls, DetectionsThatMakeNoObjectAreOne) {
  const auto lines = shortfalls(run_of(10, 0, OdometryReason::none, 0), 64);
  ASSERT_EQ(lines.size(), 1U);
  EXPECT_EQ(lines[0].find("64 detections and no object"), 0U);
}

}  // namespace
}  // namespace saker::tools
