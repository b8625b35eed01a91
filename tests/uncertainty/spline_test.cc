#include "saker/uncertainty/spline.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>

namespace saker::uncertainty {
namespace {

constexpr double kPi = std::numbers::pi;
const Intervals kIntervals{{2, 4, 8, 12}, 6};

/// Even in the first entry, odd in the second.
SplineSurface surface_of(const std::function<Eigen::Vector2d(double, double)>& f) {
  std::vector<Eigen::VectorXd> nodes;
  for (int range = 0; range < kIntervals.ranges(); ++range) {
    for (int sector = 0; sector < kIntervals.sectors; ++sector) {
      nodes.emplace_back(f(kIntervals.range_centre(range), kIntervals.sector_centre(sector)));
    }
  }
  return {kIntervals, nodes, Eigen::Vector2d(1, -1)};
}

Eigen::Vector2d wave(double range, double angle) {
  return {range * std::cos(angle), 0.1 * range * range * std::sin(angle)};
}

TEST(SplineTest, PassesThroughTheIntervalsCentres) {
  const SplineSurface surface = surface_of(wave);
  for (int range = 0; range < kIntervals.ranges(); ++range) {
    for (int sector = 0; sector < kIntervals.sectors; ++sector) {
      const double r = kIntervals.range_centre(range), a = kIntervals.sector_centre(sector);
      EXPECT_TRUE(surface.at(r, a).isApprox(wave(r, a), 1e-12));
    }
  }
}

TEST(SplineTest, WhatTheMirrorTurnsVanishesInThePlaneOfSymmetry) {
  const SplineSurface surface = surface_of(wave);
  EXPECT_NEAR(surface.at(6, 0)[1], 0, 1e-12);
  EXPECT_NEAR(surface.at(6, kPi)[1], 0, 1e-12);
}

TEST(SplineTest, StaysBetweenNeighbouringValues) {
  const SplineSurface surface = surface_of([](double range, double angle) {
    return Eigen::Vector2d(range > 5 && angle > 1.5 ? 1 : 0, 0);
  });
  for (double range = 0; range < 20; range += 0.1) {
    for (double angle = 0; angle <= kPi; angle += 0.05) {
      EXPECT_GE(surface.at(range, angle)[0], -1e-12);
      EXPECT_LE(surface.at(range, angle)[0], 1 + 1e-12);
    }
  }
}

TEST(SplineTest, IsSmoothAcrossIntervalsAndConstantBeyondTheOuterCentres) {
  const SplineSurface surface = surface_of(wave);
  const auto slope = [&](double range) {
    return (surface.at(range + 1e-6, 1)[0] - surface.at(range - 1e-6, 1)[0]) / 2e-6;
  };
  EXPECT_NEAR(slope(6 - 1e-5), slope(6 + 1e-5), 1e-3);  // at the middle interval's centre
  EXPECT_EQ(surface.at(0.5, 1), surface.at(3, 1));
  EXPECT_EQ(surface.at(99, 1), surface.at(10, 1));
}

TEST(IntervalsTest, AViewFallsIntoItsIntervalAndEachSideIsACellOfItsOwn) {
  const View left{5, kPi / 4, NAN, NAN}, right{5, -kPi / 4, NAN, NAN};
  EXPECT_EQ(kIntervals.of(left), kIntervals.index(1, 1));
  EXPECT_EQ(kIntervals.of(left), kIntervals.of(right));
  EXPECT_NE(kIntervals.cell_of(left), kIntervals.cell_of(right));
  EXPECT_EQ(kIntervals.of({0.5, 0, NAN, NAN}), kIntervals.index(0, 0));
  EXPECT_EQ(kIntervals.of({50, kPi, NAN, NAN}), kIntervals.index(2, 5));
}

TEST(IntervalsTest, ACylinderHasNoSides) {
  const Intervals intervals{{2, 4, 8}, 1};
  EXPECT_EQ(intervals.cell_of({5, 0, NAN, NAN}), intervals.cell_of({5, -0.5, NAN, NAN}));
}

}  // namespace
}  // namespace saker::uncertainty
