#include "saker/detection/hull.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "saker/core/rng.h"

namespace saker::detection {
namespace {

using Points = std::vector<Eigen::Vector2d>;

double cross(const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  return a.x() * b.y() - a.y() * b.x();
}

/// Positive where the vertices run counter-clockwise.
double area(const Points& hull) {
  double sum = 0;
  for (std::size_t i = 0; i < hull.size(); ++i) {
    sum += 0.5 * cross(hull[i], hull[(i + 1) % hull.size()]);
  }
  return sum;
}

Points cloud(std::uint64_t seed) {
  core::Rng rng(seed);
  Points points;
  for (int i = 0; i < 200; ++i) points.emplace_back(rng.normal(0, 3), rng.normal(0, 1));
  return points;
}

Points turned(Points points, double angle) {
  for (Eigen::Vector2d& p : points) p = Eigen::Rotation2Dd(angle) * p;
  return points;
}

TEST(ConvexHull, OfAFilledSquareIsItsCornersCounterClockwise) {
  Points points;
  for (int x = 0; x <= 4; ++x) {
    for (int y = 0; y <= 4; ++y) points.emplace_back(x, y);
  }
  const Points hull = convex_hull(points);
  EXPECT_EQ(hull, (Points{{0, 0}, {4, 0}, {4, 4}, {0, 4}}));
}

TEST(ConvexHull, HasEveryPointOnItsLeft) {
  const Points points = cloud(1), hull = convex_hull(points);
  for (std::size_t i = 0; i < hull.size(); ++i) {
    const Eigen::Vector2d& from = hull[i];
    const Eigen::Vector2d edge = hull[(i + 1) % hull.size()] - from;
    for (const Eigen::Vector2d& p : points) EXPECT_GE(cross(edge, p - from), -1e-12);
  }
}

TEST(ConvexHull, IsMadeOfThePointsAndIsItsOwnHull) {
  const Points points = cloud(2), hull = convex_hull(points);
  for (const Eigen::Vector2d& vertex : hull)
    EXPECT_NE(std::ranges::find(points, vertex), points.end());
  EXPECT_EQ(convex_hull(hull), hull);
}

TEST(ConvexHull, KeepsItsAreaWhereThePointsAreTurnedOrCountedTwice) {
  Points points = cloud(3);
  const double before = area(convex_hull(points));
  EXPECT_GT(before, 0);
  for (const double angle : {0.3, 1.7, -2.9}) {
    EXPECT_NEAR(area(convex_hull(turned(points, angle))), before, 1e-9) << angle;
  }
  const Points again = points;
  points.insert(points.end(), again.rbegin(), again.rend());
  EXPECT_EQ(area(convex_hull(points)), before);
}

TEST(ConvexHull, OfPointsThatSpanNoAreaIsTheirDistinctEnds) {
  EXPECT_TRUE(convex_hull({}).empty());
  EXPECT_EQ(convex_hull({{1, 2}}), (Points{{1, 2}}));
  EXPECT_EQ(convex_hull({{1, 2}, {1, 2}, {1, 2}}), (Points{{1, 2}}));
  EXPECT_EQ(convex_hull({{2, 2}, {0, 0}, {3, 3}, {1, 1}}), (Points{{0, 0}, {3, 3}}));
}

TEST(PrincipalDirection, IsThatOfALine) {
  for (const double angle : {0.0, 0.5, 1.5, -1.2}) {
    Points points;
    for (double t = -2; t <= 2; t += 0.5) {
      points.emplace_back(5 + t * std::cos(angle), -3 + t * std::sin(angle));
    }
    EXPECT_NEAR(std::remainder(principal_direction(points) - angle, M_PI), 0, 1e-9) << angle;
  }
}

TEST(PrincipalDirection, TurnsWithThePoints) {
  const Points points = cloud(4);
  const double before = principal_direction(points);
  for (const double angle : {0.4, 1.3, 2.2}) {
    const double after = principal_direction(turned(points, angle));
    EXPECT_NEAR(std::remainder(after - before - angle, M_PI), 0, 1e-9) << angle;
  }
}

TEST(PrincipalDirection, OfFewerThanTwoPointsIsZero) {
  EXPECT_EQ(principal_direction({}), 0);
  EXPECT_EQ(principal_direction({{3, 4}}), 0);
}

}  // namespace
}  // namespace saker::detection
