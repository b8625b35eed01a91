#include "saker/simulation/sensor/scan_points.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>

namespace saker::simulation {
namespace {

std::vector<ScanPoint> grid(int rows, int columns) {
  std::vector<ScanPoint> points;
  for (int row = 0; row < rows; ++row) {
    for (int column = 0; column < columns; ++column) {
      const double azimuth = 1 - 2 * M_PI * column / columns;
      ScanPoint p;
      p.position = {static_cast<float>(10 * std::cos(azimuth)),
                    static_cast<float>(10 * std::sin(azimuth)), static_cast<float>(-row)};
      p.ring = static_cast<std::uint16_t>(row);
      p.column = column;
      p.part = row % 2;
      points.push_back(p);
    }
  }
  return points;
}

TEST(ScanPoints, RingsStayTogetherAndTurnLeftwards) {
  core::Rng rng(1);
  std::vector<ScanPoint> points = grid(4, 100);
  put_in_order(PointOrder::rings, 4, 12, rng, points);
  for (std::size_t k = 1; k < points.size(); ++k) {
    if (points[k].ring != points[k - 1].ring) continue;
    EXPECT_GT(std::atan2(points[k].position.y(), points[k].position.x()),
              std::atan2(points[k - 1].position.y(), points[k - 1].position.x()));
  }
}

TEST(ScanPoints, FiringsRunColumnByColumnInOneOrderOfRows) {
  core::Rng rng(1);
  std::vector<ScanPoint> points = grid(8, 50);
  put_in_order(PointOrder::firings, 8, 12, rng, points);
  for (std::size_t k = 4; k < points.size() / 2; ++k) {
    EXPECT_EQ(points[k].column, points[k - 4].column + 1);
    EXPECT_EQ(points[k].ring, points[k - 4].ring);
  }
}

TEST(ScanPoints, StackedSensorsFollowEachOtherAndNoPointIsLost) {
  for (const PointOrder order : {PointOrder::rings, PointOrder::firings, PointOrder::packets}) {
    core::Rng rng(2);
    std::vector<ScanPoint> points = grid(8, 50);
    put_in_order(order, 8, 6, rng, points);
    EXPECT_EQ(points.size(), 400U);
    EXPECT_TRUE(std::is_sorted(points.begin(), points.end(), [](const auto& a, const auto& b) {
      return a.part < b.part;
    })) << name_of(order);
  }
}

TEST(ScanPoints, CompensationPutsAMovingWallBackInPlace) {
  std::vector<ScanPoint> points = grid(1, 100);
  for (ScanPoint& p : points)  // a wall at x = 50 seen while driving 2 m towards it
    p.position = {static_cast<float>(50 - 0.02 * p.column), 0, 0};
  move_points([](int column) { return placed(0.02 * column, 0, 0); }, 100, points);
  for (const ScanPoint& p : points) EXPECT_NEAR(p.position.x(), 50, 1e-4);
}

TEST(ScanPoints, EveryOrderKeepsEveryPoint) {
  for (const PointOrder order : {PointOrder::rings, PointOrder::firings, PointOrder::packets}) {
    core::Rng rng(5);
    std::vector<ScanPoint> points = grid(6, 50);
    put_in_order(order, 6, 12, rng, points);
    std::map<std::pair<int, int>, int> seen;
    for (const ScanPoint& p : points) ++seen[{p.ring, p.column}];
    EXPECT_EQ(seen.size(), 300U) << name_of(order);
    EXPECT_EQ(points.size(), 300U) << name_of(order);
  }
}

TEST(ScanPoints, PacketsFollowEachOtherInTheOrderOfTime) {
  core::Rng rng(2);
  std::vector<ScanPoint> points = grid(4, 60);
  for (ScanPoint& p : points) p.part = 0;
  put_in_order(PointOrder::packets, 4, 12, rng, points);
  for (std::size_t i = 1; i < points.size(); ++i)
    EXPECT_LE(points[i - 1].column / 12, points[i].column / 12);
  for (std::size_t i = 1; i < 12; ++i) {  // of the first packet one row after the other
    EXPECT_EQ(points[i].ring, points[0].ring);
    EXPECT_EQ(points[i].column, points[i - 1].column + 1);
  }
}

TEST(ScanPoints, LasersThatAreNeighboursDoNotFireOneAfterTheOther) {
  core::Rng rng(4);
  std::vector<ScanPoint> points = grid(64, 3);
  for (ScanPoint& p : points) p.part = 0;
  put_in_order(PointOrder::firings, 64, 12, rng, points);
  int neighbours = 0;
  for (std::size_t i = 1; i < 64; ++i)
    neighbours += std::abs(points[i].ring - points[i - 1].ring) == 1;
  EXPECT_LT(neighbours, 10);
}

TEST(ScanPoints, MovedEachByThePoseOfItsColumn) {
  std::vector<ScanPoint> points = grid(2, 10);
  const std::vector<ScanPoint> before = points;
  move_points([](int column) { return placed(column, 0, 0); }, 10, points);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Eigen::Vector3f moved = points[i].position - before[i].position;
    EXPECT_NEAR(moved.x(), static_cast<float>(points[i].column), 1e-5);
    EXPECT_NEAR(moved.tail<2>().norm(), 0, 1e-6);
  }
}

}  // namespace
}  // namespace saker::simulation
