#include "saker/detection/hull_fitter.h"

#include <gtest/gtest.h>

#include <cmath>

namespace saker::detection {
namespace {

/// The outline of a rectangle about the origin, its length along `yaw`.
Places outline(double length, double width, double yaw) {
  const Eigen::Rotation2Dd turn(yaw);
  Places places;
  for (double t = -0.5; t <= 0.5; t += 0.01) {
    for (const double side : {-0.5, 0.5}) {
      // Bowed by a little, so that the hull has many vertices.
      const double bow = side * (1 + 0.02 * (1 - 4 * t * t));
      places.emplace_back(turn * Eigen::Vector2d(length * t, width * bow));
      places.emplace_back(turn * Eigen::Vector2d(length * bow, width * t));
    }
  }
  return places;
}

Plan fit(const Places& places) {
  const Beams beams;
  const Surroundings surroundings({});
  const Sight sight{{Eigen::Vector3d(0, -8, 2)}, beams, surroundings, SE3::Identity()};
  const VehicleView view{places, static_cast<int>(places.size()), 1.5, sight};
  const HullFitter fitter({});
  return fitter.fit(view, fitter.outline(view));
}

TEST(HullFitter, LongerSideIsTheLength) {
  for (const double yaw : {0.0, 0.4, 1.3, -0.7}) {
    const Plan plan = fit(outline(4.5, 1.8, yaw));
    EXPECT_LT(std::abs(std::remainder(plan.heading - yaw, M_PI)), 0.03) << yaw;
    EXPECT_NEAR(plan.axis[0].size(), 4.5, 0.15) << yaw;
    EXPECT_NEAR(plan.axis[1].size(), 1.8, 0.1) << yaw;
  }
}

TEST(HullFitter, WhatWasNotSeenIsNotMadeUp) {
  Places places = outline(4.5, 1.8, 0);
  std::erase_if(places, [](const Eigen::Vector2d& p) { return p.x() > 0.5; });
  EXPECT_LT(fit(places).axis[0].size(), 2.8);
}

TEST(HullFitter, EdgesAreWorseKnownFromFarther) {
  Places places = outline(4.5, 1.8, 0);
  const double near = fit(places).axis[0].covariance(1, 1);
  for (Eigen::Vector2d& p : places) p.y() += 40;
  EXPECT_GT(fit(places).axis[0].covariance(1, 1), 2 * near);
}

}  // namespace
}  // namespace saker::detection
