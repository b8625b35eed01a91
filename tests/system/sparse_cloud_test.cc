#include "tools/saker/replay/sparse_cloud.h"

#include <gtest/gtest.h>

namespace saker::tools {
namespace {

std::vector<Eigen::Vector3f> row(std::size_t count) {
  std::vector<Eigen::Vector3f> points;
  for (std::size_t i = 0; i < count; ++i) points.emplace_back(static_cast<float>(i), 0, 0);
  return points;
}

SE3 moved(double x) {
  SE3 T = SE3::Identity();
  T.translation().x() = x;
  return T;
}

TEST(SparseCloud, KeepsSomePointsOfAScanEvenlyChosen) {
  SparseCloud cloud(10);
  cloud.add(row(100));
  const auto points = cloud.in_world({SE3::Identity()});
  ASSERT_EQ(points.size(), 10u);
  EXPECT_EQ(points[3].x(), 30);
}

TEST(SparseCloud, PutsEachScanWhereItWas) {
  SparseCloud cloud(10);
  cloud.add(row(1));
  cloud.add(row(1));
  const auto points = cloud.in_world({moved(5), moved(7)});
  ASSERT_EQ(points.size(), 2u);
  EXPECT_EQ(points[0].x(), 5);
  EXPECT_EQ(points[1].x(), 7);
}

TEST(SparseCloud, AScanWithoutPointsCountsAndIsNoScan) {
  SparseCloud cloud(10);
  cloud.add(row(2));
  cloud.add({});
  cloud.add(row(3));
  const std::vector<Time> stamps = {10, 20, 30};
  const auto scans = cloud.scans(stamps, {moved(1), moved(2), moved(3)});
  ASSERT_EQ(scans.size(), 2u);
  EXPECT_EQ(scans[1].stamp, 30);
  EXPECT_EQ(scans[1].T_odom_lidar.translation().x(), 3);
  EXPECT_EQ(scans[1].points->size(), 3u);
}

TEST(SparseCloud, WhatIsNotFiniteIsLeftOut) {
  SparseCloud cloud(10);
  auto points = row(3);
  points[1].y() = NAN;
  cloud.add(points);
  EXPECT_EQ(cloud.in_world({SE3::Identity()}).size(), 2u);
}

TEST(SparseCloud, ScansWithoutAPoseAreLeftOut) {
  SparseCloud cloud(10);
  cloud.add(row(1));
  cloud.add(row(1));
  EXPECT_EQ(cloud.in_world({SE3::Identity()}).size(), 1u);
  EXPECT_EQ(cloud.scans(std::vector<Time>{1, 2}, {SE3::Identity()}).size(), 1u);
}

}  // namespace
}  // namespace saker::tools
