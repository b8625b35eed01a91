#include "saker/active/discovery/sweep_lines.h"

#include <gtest/gtest.h>

#include <limits>

#include "made_fence.h"

namespace saker::active {
namespace {

using Eigen::Vector2d;
using namespace made;

double distance_to(const SweepLine& line, const Vector2d& p) {
  const Vector2d along = line.to - line.from;
  const double t = std::clamp((p - line.from).dot(along) / along.squaredNorm(), 0.0, 1.0);
  return (p - line.from - t * along).norm();
}

double farthest_from(const std::vector<SweepLine>& lines, const motion::Geofence& fence) {
  double farthest = 0;
  for (const Vector2d& p : points_in(fence)) {
    double nearest = std::numeric_limits<double>::infinity();
    for (const SweepLine& line : lines) nearest = std::min(nearest, distance_to(line, p));
    farthest = std::max(farthest, nearest);
  }
  return farthest;
}

TEST(SweepLines, OfARectangleRunAlongItAndLeaveNothingFartherThanHalfTheSpacing) {
  const motion::Geofence fence = fence_of({{0, 0}, {100, 0}, {100, 40}, {0, 40}});
  const auto lines = sweep_lines(fence.corners(), 16);
  ASSERT_EQ(lines.size(), 3U);
  for (const SweepLine& line : lines) EXPECT_NEAR((line.to - line.from).norm(), 100, 1e-9);
  EXPECT_LE(farthest_from(lines, fence), 8);
}

TEST(SweepLines, AreFlownBackAndForth) {
  const auto lines = sweep_lines(fence_of({{0, 0}, {100, 0}, {100, 60}, {0, 60}}).corners(), 15);
  for (std::size_t i = 1; i < lines.size(); ++i) {
    EXPECT_NEAR((lines[i].from - lines[i - 1].to).norm(), 15, 1e-9);
  }
}

TEST(SweepLines, OfConvexAndConcavePolygonsComeWithinTheSpacingOfEveryPoint) {
  for (const auto& [name, corners] : shapes()) {
    const motion::Geofence fence = fence_of(corners);
    EXPECT_LE(farthest_from(sweep_lines(fence.corners(), 10), fence), 10) << name;
  }
}

TEST(SweepLines, StayInThePolygon) {
  for (const auto& [name, corners] : shapes()) {
    const motion::Geofence fence = fence_of(corners);
    for (const Vector2d& stop : stops_on(sweep_lines(fence.corners(), 7), 2, 0.5)) {
      EXPECT_GE(fence.inside_polygon_m(stop), 0) << name;
    }
  }
}

TEST(SweepLines, StopsAreAStepApartAndInsetFromTheEnds) {
  const SweepLine line{{0, 0}, {23, 0}};
  const auto stops = stops_on(std::span(&line, 1), 5, 1.5);
  ASSERT_EQ(stops.size(), 5U);
  EXPECT_DOUBLE_EQ(stops.front().x(), 1.5);
  EXPECT_DOUBLE_EQ(stops.back().x(), 21.5);
  for (std::size_t i = 1; i < stops.size(); ++i) EXPECT_NEAR(stops[i].x() - stops[i - 1].x(), 5, 1);
}

TEST(SweepLines, ALineTooShortForItsInsetsHasItsMiddle) {
  const SweepLine line{{0, 0}, {2, 0}};
  const auto stops = stops_on(std::span(&line, 1), 5, 1.5);
  ASSERT_EQ(stops.size(), 1U);
  EXPECT_DOUBLE_EQ(stops.front().x(), 1);
}

TEST(SweepLines, OfAnAreaWithoutWidthAreNoneOrLieInIt) {
  const std::vector<Vector2d> flat = {{0, 0}, {10, 0}, {20, 0}};
  for (const SweepLine& line : sweep_lines(flat, 5)) EXPECT_EQ(line.from.y(), 0);
}

}  // namespace
}  // namespace saker::active
