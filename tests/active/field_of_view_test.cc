#include "saker/active/views/field_of_view.h"

#include <gtest/gtest.h>

#include <numbers>

#include "made_street.h"
#include "saker/core/rng.h"

namespace saker::active {
namespace {

using namespace made;
using std::numbers::pi;

const FieldOfViewConfig kView;

Eigen::Matrix3d turned(double angle, const Eigen::Vector3d& axis) {
  return Eigen::AngleAxisd(angle, axis).toRotationMatrix();
}

FieldOfViewConfig tilted(double roll_deg, double pitch_deg) {
  FieldOfViewConfig view;
  view.R_body_lidar = turned(pitch_deg * pi / 180, Eigen::Vector3d::UnitY()) *
                      turned(roll_deg * pi / 180, Eigen::Vector3d::UnitX());
  view.nearest_m = 0;
  view.farthest_m = 60;
  return view;
}

double elevation_deg(const Eigen::Vector3d& p_lidar) {
  return std::atan2(p_lidar.z(), p_lidar.head<2>().norm()) * 180 / pi;
}

/// By its surface, point for point, in the lidar's own frame.
bool every_point_between_beams(const Eigen::Vector3d& eye, double yaw,
                               const objects::Cuboid& target, const FieldOfViewConfig& view) {
  const Eigen::Matrix3d R_world_lidar = turned(yaw, Eigen::Vector3d::UnitZ()) * view.R_body_lidar;
  for (double x = -0.5; x <= 0.501; x += 0.02) {
    for (double y = -0.5; y <= 0.501; y += 0.02) {
      for (const double z : {-0.5, -0.25, 0.0, 0.25, 0.5}) {
        const Eigen::Vector3d p = target.pose * Eigen::Vector3d(x, y, z).cwiseProduct(target.size);
        const double elevation = elevation_deg(R_world_lidar.transpose() * (p - eye));
        if (elevation < view.lowest_deg || elevation > view.highest_deg) return false;
      }
    }
  }
  return true;
}

struct Counts {
  int seen = 0, hidden = 0, near_the_edge = 0;
};

/// Compares a target with its points. The grid of points misses the nearest one by centimetres: let
/// the edge itself be.
void compare(const Eigen::Vector3d& eye, double yaw, const objects::Cuboid& target,
             const FieldOfViewConfig& view, Counts& counts) {
  if (in_field_of_view(eye, yaw, target, view, 0.3) !=
      in_field_of_view(eye, yaw, target, view, -0.3)) {
    ++counts.near_the_edge;
    return;
  }
  const bool in_view = in_field_of_view(eye, yaw, target, view, 0);
  ++(in_view ? counts.seen : counts.hidden);
  EXPECT_EQ(in_view, every_point_between_beams(eye, yaw, target, view)) << eye.transpose();
}

TEST(FieldOfView, HoldsATargetWhenItHoldsEachOfItsPoints) {
  core::Rng rng(1);
  Counts counts;
  for (int trial = 0; trial < 400; ++trial) {
    const objects::Cuboid target = car(0, 0, rng.uniform(-pi, pi));
    const double distance = rng.uniform(5, 15), bearing = rng.uniform(-pi, pi);
    const Eigen::Vector3d eye(distance * std::cos(bearing), distance * std::sin(bearing),
                              rng.uniform(0.5, 6));
    compare(eye, rng.uniform(-pi, pi), target, kView, counts);
  }
  EXPECT_GT(counts.seen, 100);
  EXPECT_GT(counts.hidden, 100);
  EXPECT_LT(counts.near_the_edge, 60);
}

TEST(FieldOfView, OfATiltedLidarHoldsATargetWhenItHoldsEachOfItsPoints) {
  core::Rng rng(2);
  Counts counts;
  for (int trial = 0; trial < 1000; ++trial) {
    const FieldOfViewConfig view = tilted(rng.uniform(-100, 100), rng.uniform(-60, 60));
    const objects::Cuboid target = car(0, 0, rng.uniform(-pi, pi));
    const Eigen::Vector3d eye(rng.uniform(-20, 20), rng.uniform(-20, 20), rng.uniform(3, 30));
    compare(eye, rng.uniform(-pi, pi), target, view, counts);
  }
  EXPECT_GT(counts.seen, 200);
  EXPECT_GT(counts.hidden, 200);
  EXPECT_LT(counts.near_the_edge, 200);
}

TEST(FieldOfView, OfALidarOnItsSideEndsAtTheBeamsOverTheGround) {
  const FieldOfViewConfig view = tilted(90, 0);
  const objects::Cuboid target = car(0, 0);
  const double top_m = 28.5, half_m = 0.9;  // below an eye at 30 m
  const double reach_m = top_m * std::tan(22.5 * pi / 180) - half_m;
  EXPECT_TRUE(in_field_of_view({0, 0, 30}, 0, target, view, 0)) << "right above";
  EXPECT_TRUE(in_field_of_view({0, reach_m - 0.05, 30}, 0, target, view, 0));
  EXPECT_FALSE(in_field_of_view({0, reach_m + 0.05, 30}, 0, target, view, 0));
  EXPECT_TRUE(in_field_of_view({30, 0, 30}, 0, target, view, 0)) << "ahead and behind it sees all";
  EXPECT_FALSE(in_field_of_view({0, 30, 30}, 0, target, view, 0));
  EXPECT_TRUE(in_field_of_view({0, 30, 30}, pi / 2, target, view, 0)) << "turned to it";
}

TEST(FieldOfView, EndsTooNearAndTooFar) {
  const objects::Cuboid target = car(0, 0);
  EXPECT_TRUE(in_field_of_view({8, 0, 1.5}, 0, target, kView, 0));
  EXPECT_FALSE(in_field_of_view({2.2 + 0.9 * kView.nearest_m, 0, 0.75}, 0, target, kView, 0));
  EXPECT_FALSE(in_field_of_view({kView.farthest_m + 0.1, 0, 1.5}, 0, target, kView, 0));
  EXPECT_FALSE(in_field_of_view({0, 0, 3}, 0, target, kView, 0)) << "right above";
}

TEST(FieldOfView, MarginTakesFromBothEnds) {
  const objects::Cuboid target = car(0, 0);
  const double needed = 3 / std::tan(20.5 * pi / 180);  // beyond the long side, 3 m up
  EXPECT_FALSE(in_field_of_view({0, 0.9 + needed - 0.05, 3}, 0, target, kView, 2));
  EXPECT_TRUE(in_field_of_view({0, 0.9 + needed + 0.05, 3}, 0, target, kView, 2));
  EXPECT_TRUE(in_field_of_view({0, 0.9 + needed - 0.05, 3}, 0, target, kView, 1));
}

TEST(FieldOfView, WhereALidarLooksToIsMidwayBetweenItsBeams) {
  core::Rng rng(3);
  int midway = 0;
  for (int trial = 0; trial < 300; ++trial) {
    const FieldOfViewConfig view = tilted(rng.uniform(-120, 120), rng.uniform(-60, 60));
    const double elevation = rng.uniform(-1.2, 0.3), azimuth = viewing_azimuth(elevation, view);
    const auto over_middle_deg = [&](double direction) {
      const Eigen::Vector3d ray(std::cos(direction) * std::cos(elevation),
                                std::sin(direction) * std::cos(elevation), std::sin(elevation));
      return std::abs(elevation_deg(view.R_body_lidar.transpose() * ray));
    };
    double least = 90;
    for (double other = -pi; other < pi; other += 0.01) {
      least = std::min(least, over_middle_deg(other));
    }
    EXPECT_LT(over_middle_deg(azimuth), least + 1e-6);
    midway += over_middle_deg(azimuth) < 1e-6;
  }
  EXPECT_GT(midway, 100);
  EXPECT_EQ(viewing_azimuth(-0.5, kView), 0) << "level: all around";
}

TEST(FieldOfView, OfALevelLidarIsTheWholeHorizonAndOfATiltedOneAPart) {
  EXPECT_TRUE(sees_all_around(kView));
  EXPECT_TRUE(sees_all_around(tilted(15, 0)));
  EXPECT_FALSE(sees_all_around(tilted(25, 0)));
  EXPECT_TRUE(sees_ahead(tilted(90, 0)));
  EXPECT_TRUE(sees_ahead(tilted(45, 15)));
  EXPECT_FALSE(sees_ahead(tilted(0, 45)));
}

}  // namespace
}  // namespace saker::active
