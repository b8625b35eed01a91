#include "saker/autonomy/label_counts.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

namespace saker::autonomy {
namespace {

const Eigen::Vector3f kHit(1, 2, 3);
const Eigen::Vector3f kNoReturn =
    Eigen::Vector3f::Constant(std::numeric_limits<float>::quiet_NaN());

TEST(LabelCounts, AreOfPointsThatAreThere) {
  const std::vector<Eigen::Vector3f> points = {kHit, kNoReturn, kHit, kHit, kNoReturn};
  const LabelCounts counts = counted(points, {{1, 0, 0, 3, 2}, {0.5F, 0, 0.25F, 1, 1}});
  EXPECT_EQ(counts.points, 3);
  EXPECT_EQ(counts.classified, 2);
  EXPECT_EQ(counts.probability_millionths, 1'750'000);
  EXPECT_DOUBLE_EQ(counts.classified_share(), 2.0 / 3);
}

TEST(LabelCounts, ShareDoesNotSinkWithTheBeamsThatMeetTheSky) {
  std::vector<Eigen::Vector3f> points(10, kHit);
  lidar::Labels labels{std::vector<std::uint8_t>(10, 1), std::vector<float>(10, 1)};
  const double before = counted(points, labels).classified_share();
  points.resize(100, kNoReturn);
  labels.classes.resize(100, 0);
  labels.probability.resize(100, 0);
  EXPECT_DOUBLE_EQ(counted(points, labels).classified_share(), before);
}

TEST(LabelCounts, OfNothingShareNothing) {
  EXPECT_EQ(counted({}, {}).classified_share(), 0);
  EXPECT_EQ(counted(std::vector{kNoReturn}, {{1}, {1}}).classified_share(), 0);
}

TEST(LabelCounts, OfPointsWithoutLabelsAreNone) {
  EXPECT_EQ(counted(std::vector{kHit, kHit}, {{1}, {1}}).points, 1);
}

}  // namespace
}  // namespace saker::autonomy
