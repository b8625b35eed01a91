#include "detection/beams.h"

#include <gtest/gtest.h>

namespace saker::detection {
namespace {

objects::Cuboid box_at(const Eigen::Vector3d& place, double yaw = 0) {
  objects::Cuboid box{SE3::Identity(), {2, 1, 1}};
  box.pose.linear() = Eigen::AngleAxisd(yaw, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  box.pose.translation() = place;
  return box;
}

/// One beam from each of two sensors.
Beams two_beams(const Eigen::Vector3f& first, const Eigen::Vector3f& second) {
  Window window;
  window.sensors = {{0, 0, 0}, {0, 5, 0}};
  window.beams = {{first, 0}, {second, 1}};
  Beams beams;
  beams.fill(window);
  return beams;
}

TEST(Beams, ThatEndBehindABoxWentThroughIt) {
  EXPECT_EQ(two_beams({10, 0, 0}, {10, 5, 0}).through(box_at({5, 0, 0})), 1);
  EXPECT_EQ(two_beams({10, 0, 0}, {10, 0, 0}).through(box_at({8, 0.5, 0})), 2);
}

TEST(Beams, ThatEndInABoxOrInFrontOfItDidNot) {
  EXPECT_EQ(two_beams({5, 0, 0}, {10, 5, 0}).through(box_at({5, 0, 0})), 0);
  EXPECT_EQ(two_beams({3, 0, 0}, {10, 5, 0}).through(box_at({5, 0, 0})), 0);
}

TEST(Beams, ThatPassBesideABoxDidNot) {
  const Beams beams = two_beams({10, 0, 0}, {10, 5, 0});
  EXPECT_EQ(beams.through(box_at({5, 0.8, 0})), 0);
  EXPECT_EQ(beams.through(box_at({5, 0.8, 0}, M_PI / 2)), 1);
  EXPECT_EQ(beams.through(box_at({5, 0, 0.8})), 0);
  EXPECT_EQ(beams.through(box_at({-5, 0, 0})), 0);
}

TEST(Beams, WhereTheAzimuthWrapsNoneIsLost) {
  for (const double y : {-0.2, 0.0, 0.2}) {
    const Beams beams = two_beams({-10, static_cast<float>(y), 0}, {10, 5, 0});
    EXPECT_EQ(beams.through(box_at({-5, 0, 0})), 1) << y;
    EXPECT_EQ(beams.through(box_at({-5, 0.1, 0})), 1) << y;
  }
}

TEST(Beams, NoneGoesThroughABoxThatHoldsNothing) {
  objects::Cuboid box = box_at({5, 0, 0});
  box.size.x() = -1;
  EXPECT_EQ(two_beams({10, 0, 0}, {10, 5, 0}).through(box), 0);
}

TEST(Beams, OfAnEmptyWindowAreNone) {
  Beams beams = two_beams({10, 0, 0}, {10, 5, 0});
  beams.fill({});
  EXPECT_EQ(beams.through(box_at({5, 0, 0})), 0);
}

}  // namespace
}  // namespace saker::detection
