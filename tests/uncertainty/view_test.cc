#include "saker/uncertainty/view.h"

#include <gtest/gtest.h>

#include <numbers>

namespace saker::uncertainty {
namespace {

constexpr double kPi = std::numbers::pi;

objects::Cuboid cuboid_at(double x, double y, double z, double heading) {
  objects::Cuboid cuboid;
  cuboid.pose.translation() << x, y, z;
  cuboid.pose.linear() = Eigen::AngleAxisd(heading, Eigen::Vector3d::UnitZ()).matrix();
  cuboid.size << 4.5, 1.8, 1.5;
  return cuboid;
}

TEST(ViewTest, AngleIsZeroInFrontAndAQuarterTurnAtTheLeft) {
  const objects::Model model = cuboid_at(2, 1, 0.75, kPi / 2);  // its front looks along +y
  EXPECT_NEAR(view_of({2, 9, 3}, model).angle, 0, 1e-12);
  EXPECT_NEAR(view_of({-6, 1, 3}, model).angle, kPi / 2, 1e-12);
  EXPECT_NEAR(view_of({10, 1, 3}, model).angle, -kPi / 2, 1e-12);
}

TEST(ViewTest, BehindIsPlusPiWhateverTheHeading) {
  for (const double heading : {0.0, 0.7, 2.5, -3.0, kPi}) {
    const objects::Cuboid cuboid = cuboid_at(0, 0, 0.75, heading);
    const Eigen::Vector3d behind = cuboid.pose * Eigen::Vector3d(-6, 0, 1);
    EXPECT_NEAR(std::abs(view_of(behind, cuboid).angle), kPi, 1e-9);
    EXPECT_LE(view_of(behind, cuboid).angle, kPi);
  }
}

TEST(ViewTest, RangeIsHorizontalAndElevationIsOverTheMiddle) {
  const View view = view_of({3, 4, 5.75}, cuboid_at(0, 0, 0.75, 0.3));
  EXPECT_NEAR(view.range, 5, 1e-12);
  EXPECT_NEAR(view.elevation, kPi / 4, 1e-12);
  EXPECT_TRUE(std::isnan(view.reflectivity));
}

TEST(ViewTest, ACylinderHasNoAngleAndItsMiddleIsHalfWayUp) {
  objects::Cylinder cylinder;
  cylinder.root << 0, 0, 0;
  cylinder.height = 4;
  const View view = view_of({0, -6, 2}, cylinder);
  EXPECT_EQ(view.angle, 0);
  EXPECT_NEAR(view.elevation, 0, 1e-12);
  EXPECT_NEAR(view.range, 6, 1e-12);
}

TEST(ViewTest, IsTheSameWhereverBothAreAndHoweverTheyAreTurned) {
  const objects::Cuboid cuboid = cuboid_at(4, -2, 0.75, 0.6);
  const Eigen::Vector3d eye(-3, 5, 4);
  const View before = view_of(eye, cuboid);
  for (const double turn : {0.4, 1.9, -2.8}) {
    SE3 T = SE3::Identity();
    T.translation() << 100, -50, 7;
    T.rotate(Eigen::AngleAxisd(turn, Eigen::Vector3d::UnitZ()));
    const View after = view_of(T * eye, objects::transformed(T, cuboid));
    EXPECT_NEAR(after.range, before.range, 1e-9) << turn;
    EXPECT_NEAR(after.angle, before.angle, 1e-9) << turn;
    EXPECT_NEAR(after.elevation, before.elevation, 1e-9) << turn;
  }
}

TEST(ViewTest, OfAVehicleTurnedRoundIsFromTheOtherSide) {
  const double angle = view_of({3, 2, 2}, cuboid_at(0, 0, 0.75, 0)).angle;
  const double turned = view_of({3, 2, 2}, cuboid_at(0, 0, 0.75, kPi)).angle;
  EXPECT_NEAR(std::remainder(turned - angle - kPi, 2 * kPi), 0, 1e-12);
}

TEST(ViewTest, ACylinderOfUnknownHeightIsSeenAtItsRoot) {
  objects::Cylinder cylinder;
  cylinder.root << 0, 0, 1;
  EXPECT_NEAR(view_of({3, 0, 4}, cylinder).elevation, kPi / 4, 1e-12);
}

}  // namespace
}  // namespace saker::uncertainty
