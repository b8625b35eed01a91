#include "saker/detection/vehicle.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <iterator>

#include "made_scene.h"

namespace saker::detection {
namespace {

using testing::hides;
using testing::MadeBox;
using testing::visible_box;

/// For boxes, whose faces do not bow.
VehicleConfig flat() {
  VehicleConfig config;
  config.faces.bow_end_m = config.faces.bow_side_m = 0;
  return config;
}

/// A box among others that hide it and the ground, by the beams of ten scans.
struct Scene {
  Eigen::Vector3d sensor;
  MadeBox box;
  std::vector<MadeBox> others = {};
  double speed = 0;
  VehicleConfig config = flat();

  [[nodiscard]] bool sees(const Eigen::Vector3d& point) const {
    return std::ranges::none_of(others, [&](const MadeBox& o) { return hides(o, sensor, point); });
  }

  [[nodiscard]] std::vector<BodyPoint> points() const {
    core::Rng rng(5);
    std::vector<BodyPoint> points;
    for (int scan = 0; scan < 10; ++scan) {
      const double seconds = 0.1 * (scan - 9);
      MadeBox now = box;
      now.x += speed * seconds * std::cos(box.yaw);
      now.y += speed * seconds * std::sin(box.yaw);
      for (const auto& p : visible_box(now, sensor, 300, 0.02, rng)) {
        if (p.z() > 0.2 && sees(p))
          points.push_back({p.cast<float>(), static_cast<float>(seconds)});
      }
    }
    return points;
  }

  /// \param hits  that beams meet beside the ground
  [[nodiscard]] Beams beams(const std::vector<Eigen::Vector3d>& hits) const {
    std::vector<MadeBox> boxes = others;
    boxes.push_back(box);
    return testing::ground_beams(sensor, boxes, 20000, hits);
  }

  [[nodiscard]] VehicleFit fit() const { return fitted_to(points()); }

  [[nodiscard]] VehicleFit fitted_to(const std::vector<BodyPoint>& points,
                                     const std::vector<Eigen::Vector3d>& hits = {}) const {
    const Sight sight{{sensor}, beams(hits), Surroundings({}), SE3::Identity()};
    const VehicleKinds kinds = vehicle_kinds({});
    return fit_vehicle(points, sight, *make_fitter(config, kinds), config, kinds);
  }
};

double length_sd(const VehicleFit& fit) { return std::sqrt(fit.covariance(6, 6)); }

double turned(const objects::Cuboid& cuboid, double yaw) {
  return std::abs(std::remainder(core::yaw(cuboid.pose.linear()) - yaw, M_PI));
}

TEST(Vehicle, IsMeasuredFromAnObliqueView) {
  for (const double yaw : {0.0, 0.4, 1.2, 2.3, -0.8}) {
    Scene scene{{0, 0, 4}, {10, 2, yaw}};
    const VehicleFit fit = scene.fit();
    ASSERT_EQ(fit.status, VehicleStatus::fitted) << yaw;
    // Its far end lies in its shadow: hits of cars end short of it.
    EXPECT_NEAR(fit.cuboid.size.x(), 4.5, 0.36) << yaw;
    EXPECT_NEAR(fit.cuboid.size.y(), 1.8, 0.15) << yaw;
    EXPECT_NEAR(fit.cuboid.size.z(), 1.5, 0.08) << yaw;
    EXPECT_LT(turned(fit.cuboid, yaw), 0.03) << yaw;
    EXPECT_LT((fit.cuboid.pose.translation() - Eigen::Vector3d(10, 2, 0.75)).norm(), 0.2) << yaw;
  }
}

TEST(Vehicle, WhoseRoofReachesItsHiddenEndIsNotLongerThanStated) {
  for (const double yaw : {0.0, 0.4, 1.2, 2.3, -0.8}) {
    const VehicleFit fit = Scene{{0, 0, 4}, {10, 2, yaw}}.fit();
    ASSERT_EQ(fit.status, VehicleStatus::fitted) << yaw;
    EXPECT_LT(std::abs(fit.cuboid.size.x() - 4.5), 2 * length_sd(fit)) << yaw;
  }
}

TEST(Vehicle, SeenFromBehindOnlyDoesNotClaimToKnowItsLength) {
  const VehicleFit fit = Scene{{0, 0, 1.2}, {12, 0, 0}}.fit();
  ASSERT_EQ(fit.status, VehicleStatus::fitted);
  EXPECT_LT(turned(fit.cuboid, 0), 0.05);
  EXPECT_NEAR(fit.cuboid.size.y(), 1.8, 0.15);
  EXPECT_GT(length_sd(fit), 0.3);
  EXPECT_LT(std::abs(fit.cuboid.size.x() - 4.5), 2 * length_sd(fit));
  EXPECT_LT(std::sqrt(fit.covariance(7, 7)), 0.45);  // either side may reach on, hidden
  EXPECT_LT(std::abs(fit.cuboid.pose.translation().x() - 12), 2 * std::sqrt(fit.covariance(3, 3)));
}

TEST(Vehicle, AsLongAsATruckAndNoHigherThanACarIsMoreThanOne) {
  const auto status = [](double height, double width) {
    return Scene{{0, -8, 1.2}, {.length = 7.3, .width = width, .height = height}}.fit().status;
  };
  EXPECT_EQ(status(1.5, 1.8), VehicleStatus::parted);
  EXPECT_EQ(status(1.5, 2.7), VehicleStatus::parted);
  EXPECT_EQ(status(2.6, 2.4), VehicleStatus::fitted);
}

TEST(Vehicle, HiddenEndOfAVanLiesFartherOutThanACars) {
  const auto length = [](double height) {
    return Scene{{0, 0, 1.2}, {.x = 12, .height = height}}.fit().cuboid.size.x();
  };
  EXPECT_GT(length(2.0) - length(1.47), 0.3);
}

TEST(Vehicle, HiddenSideOfAVanLiesFartherOutThanACars) {
  const auto width = [](double height) {
    Scene scene{{0, -8, 1.2}, {.height = height}};
    scene.others = {{.y = 2.1, .length = 8, .height = 3}};
    return scene.fit().cuboid.size.y();
  };
  EXPECT_GT(width(2.0) - width(1.47), 0.08);
}

/// Leaves of a bush about a place in the frame of a box.
void add_leaves(const MadeBox& box, const Eigen::Vector3d& middle, double radius, int count,
                std::vector<BodyPoint>& points) {
  core::Rng rng(7);
  const Eigen::Rotation2Dd turn(box.yaw);
  for (int i = 0; i < count; ++i) {
    Eigen::Vector3d leaf(rng.uniform(-1, 1), rng.uniform(-1, 1), rng.uniform(-1, 1));
    if (leaf.norm() > 1) continue;
    leaf = middle + radius * leaf;
    leaf.head<2>() = turn * leaf.head<2>() + Eigen::Vector2d(box.x, box.y);
    points.push_back({leaf.cast<float>(), 0});
  }
}

/// Where its rear lies, in the frame of a box.
double rear_of(const objects::Cuboid& cuboid, const MadeBox& box) {
  const Eigen::Vector2d middle =
      cuboid.pose.translation().head<2>() - Eigen::Vector2d(box.x, box.y);
  return (Eigen::Rotation2Dd(-box.yaw) * middle).x() - cuboid.size.x() / 2;
}

TEST(Vehicle, BushAtItsCornerMovesNoEnd) {
  const Scene scene{{0, 0, 4}, {10, 2, 0.4}};
  std::vector<BodyPoint> points = scene.points();
  add_leaves(scene.box, {-2.5, -0.3, 1}, 0.7, 30, points);  // over half of its rear
  const VehicleFit fit = scene.fitted_to(points);
  ASSERT_EQ(fit.status, VehicleStatus::fitted);
  EXPECT_NEAR(rear_of(fit.cuboid, scene.box), -2.25, 0.1);
  EXPECT_LT(turned(fit.cuboid, 0.4), 0.03);
}

TEST(Vehicle, LeavesBesideItDoNotTurnIt) {
  const Scene scene{{0, -8, 4}, {0, 0, 0}};
  std::vector<BodyPoint> points = scene.points();
  add_leaves(scene.box, {-1.6, -1, 1.5}, 1.1, 200, points);  // half of its side
  const VehicleFit fit = scene.fitted_to(points);
  ASSERT_EQ(fit.status, VehicleStatus::fitted);
  EXPECT_LT(turned(fit.cuboid, 0), 0.03);
}

TEST(Vehicle, EndThatIsHiddenIsNotKnown) {
  const Scene free{{0, 0, 2}, {12, 0, M_PI / 2}};
  EXPECT_LT(length_sd(free.fit()), 0.2);
  Scene cut = free;
  cut.others = {{.x = 9, .y = 1.4, .yaw = M_PI / 2, .length = 2.4, .height = 2}};
  const VehicleFit fit = cut.fit();
  ASSERT_EQ(fit.status, VehicleStatus::fitted);
  EXPECT_GT(length_sd(fit), 0.5);
  EXPECT_LT(std::abs(fit.cuboid.size.x() - 4.5), 2 * length_sd(fit));
}

/// What is stated of the face on the side of −y.
struct StatedFace {
  double y, sd;
};

StatedFace right_face(const VehicleFit& fit) {
  const Eigen::Matrix3d& R = fit.cuboid.pose.linear();
  const int axis = std::abs(R(1, 0)) > std::abs(R(1, 1)) ? 0 : 1;
  const double sign = R(1, axis) > 0 ? 1 : -1;
  const double variance = fit.covariance(3 + axis, 3 + axis) +
                          0.25 * fit.covariance(6 + axis, 6 + axis) -
                          sign * fit.covariance(3 + axis, 6 + axis);
  return {fit.cuboid.pose.translation().y() - 0.5 * fit.cuboid.size[axis], std::sqrt(variance)};
}

/// From the right a wall hides it up to `y`, where its near face lies at x = 12.
Scene half_hidden(double yaw, double y) {
  const double half = yaw == 0 ? 2.25 : 0.9;
  const MadeBox wall{.x = 7, .y = y * 7 / 12 - 2, .yaw = 0, .length = 1, .width = 4, .height = 3};
  return {{0, 0, 1.2}, {.x = 12 + half, .yaw = yaw}, {wall}};
}

TEST(Vehicle, WhoseHeadingIsAGuessStatesNoFaceBetterThanEitherHeadingTells) {
  const Scene scene =
      half_hidden(M_PI / 2, -0.3);  // of a side of 4.5 m 2.5 m: taken for a vehicle ahead
  const auto off = [&] {
    const StatedFace right = right_face(scene.fit());
    return (right.y + 2.25) / right.sd;
  };
  EXPECT_LT(off(), 2.5);
}

TEST(Vehicle, WhoseHeadingIsPlainStatesItsFacesAsItSeesThem) {
  EXPECT_LT(right_face(half_hidden(0, -1.2).fit()).sd, 0.3);
}

TEST(Vehicle, ClassWidthOfAHiddenSideIsStatedAsWhatOneOfManyWindowsKnows) {
  Scene scene{{0, -8, 1.2}, {.x = 0, .y = 0, .yaw = 0}};
  scene.others = {{.x = 0, .y = 2.1, .yaw = 0, .length = 8, .height = 3}};
  const VehicleFit fit = scene.fit();
  ASSERT_EQ(fit.status, VehicleStatus::fitted);
  EXPECT_NEAR(fit.cuboid.size.y(), 1.8, 0.15);
  constexpr double kClassSd = 0.07;  // m
  EXPECT_GT(std::sqrt(fit.covariance(7, 7)), 2 * kClassSd);
}

TEST(Vehicle, ThatBeamsGoThroughIsMoreThanOne) {
  const Scene first{{0, 0, 4}, {.x = 10, .y = 1.8, .yaw = M_PI / 2, .length = 2.8}};
  const Scene second{{0, 0, 4}, {.x = 10, .y = -1.8, .yaw = M_PI / 2, .length = 2.8}};
  Scene both = first;
  both.others = {second.box};
  std::vector<BodyPoint> points = first.points();
  std::ranges::copy(second.points(), std::back_inserter(points));
  EXPECT_EQ(both.fitted_to(points).status, VehicleStatus::parted);
}

std::vector<Eigen::Vector3d> hits_of(const std::vector<BodyPoint>& points) {
  std::vector<Eigen::Vector3d> hits;
  for (const BodyPoint& p : points) hits.push_back(p.position.cast<double>());
  return hits;
}

/// Those on a face across x at 10 m.
std::vector<BodyPoint> facing(std::vector<BodyPoint> points) {
  std::erase_if(points, [](const BodyPoint& p) { return p.position.x() > 10.3; });
  return points;
}

TEST(Vehicle, WhoseSideBeamsEnterIsMoreThanOne) {
  const Eigen::Vector3d sensor(0, -9, 1.2);
  const MadeBox left{.x = 12.5, .y = 1.2, .length = 5}, right{.x = 12.5, .y = -1.2, .length = 5};
  const Scene first{sensor, left, {right}}, second{sensor, right, {left}};
  std::vector<BodyPoint> points = first.points();
  std::ranges::copy(second.points(), std::back_inserter(points));
  EXPECT_EQ(first.fitted_to(facing(points), hits_of(points)).status, VehicleStatus::parted);
  // One whose side is as long, seen from there.
  const Scene one{sensor, {.x = 10.9, .yaw = M_PI / 2, .length = 4.2}};
  EXPECT_EQ(one.fitted_to(facing(one.points()), hits_of(one.points())).status,
            VehicleStatus::fitted);
}

TEST(Vehicle, OnWhoseSideSomethingWasMetAllAlongIsOneThoughBeamsEnterIt) {
  const Scene one{{0, -9, 1.2}, {.x = 10.9, .yaw = M_PI / 2, .length = 4.2}};
  const std::vector<BodyPoint> points = facing(one.points());
  std::vector<Eigen::Vector3d> hits = hits_of(points);
  for (const Eigen::Vector3d& hit : hits_of(points))
    hits.push_back(hit + Eigen::Vector3d(0.6, 0, 0));
  EXPECT_EQ(one.fitted_to(points, hits).status, VehicleStatus::fitted);
}

TEST(Vehicle, ThatMovesIsToldFromOneThatIsParked) {
  for (const double speed : {4.0, 8.0, 12.0}) {
    const VehicleFit fit = Scene{{0, 0, 2}, {12, 3, 0.3}, {}, speed}.fit();
    EXPECT_TRUE(fit.motion.moving) << speed;
    EXPECT_NEAR(fit.motion.velocity.norm(), speed, 0.8);
  }
  const Scene parked{{0, 0, 2}, {12, 3, 0.3}};
  EXPECT_FALSE(parked.fit().motion.moving);
}

TEST(Vehicle, CovarianceIsSymmetricAndPositive) {
  const VehicleFit fit = Scene{{0, 0, 2}, {12, 3, 0.3}}.fit();
  ASSERT_EQ(fit.status, VehicleStatus::fitted);
  EXPECT_LT((fit.covariance - fit.covariance.transpose()).norm(), 1e-12);
  EXPECT_GT(fit.covariance.selfadjointView<Eigen::Lower>().eigenvalues().minCoeff(), 0);
}

}  // namespace
}  // namespace saker::detection
