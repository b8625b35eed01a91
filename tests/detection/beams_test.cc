#include "saker/detection/beams.h"

#include <gtest/gtest.h>

#include "saker/core/rng.h"

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

/// Low face at x = 4.
TEST(Beams, ComeAsNearAsTheyEnterOrLeave) {
  EXPECT_NEAR(two_beams({10, 0, 0}, {10, 5, 0}).nearest(box_at({5, 0, 0}), 1, 0, {}), 0, 1e-6);
  const Beams across = two_beams({10, 0, 0}, {7.5, 0, 0});  // the second enters at (5.25, 1.5)
  EXPECT_NEAR(across.nearest(box_at({5.5, 1, 0}), 1, 0, {}), 5.25 - 4.5, 1e-5);
}

TEST(Beams, ComeAsNearAsTheOneOfSoMany) {
  const Beams beams = two_beams({10, 0, 0}, {5.5, -1, 0});  // the second enters at y = 0.5
  EXPECT_NEAR(beams.nearest(box_at({5, 0, 0}), 1, 0, {}), 0, 1e-6);
  EXPECT_NEAR(beams.nearest(box_at({5, 0, 0}), 2, 0, {}), 4.125 - 4, 1e-5);
  EXPECT_TRUE(std::isinf(beams.nearest(box_at({5, 0, 0}), 3, 0, {})));
}

TEST(Beams, ThatEndWithinABoxCameAsNear) {
  EXPECT_NEAR(two_beams({5, 0, 0}, {0, 9, 0}).nearest(box_at({5, 0, 0}), 1, 0, {}), 0, 1e-6);
}

TEST(Beams, ThatComeNearerThanTheLeastTellNothing) {
  const Beams beams = two_beams({10, 0, 0}, {0, 9, 0});
  EXPECT_NEAR(beams.nearest(box_at({5, 0, 0}), 1, 0, {}), 0, 1e-6);
  EXPECT_TRUE(std::isinf(beams.nearest(box_at({5, 0, 0}), 1, 0.2, {})));
}

TEST(Beams, ComeLessNearToAFaceThatBowsAway) {
  const Beams beams = two_beams({5, 0, 0}, {0, 9, 0});
  const Bow bow{0.3, 0.5};
  EXPECT_NEAR(beams.nearest(box_at({5, 0.5, 0}), 1, 0, bow), 0.3, 1e-6);
  EXPECT_NEAR(beams.nearest(box_at({5, 0.25, 0}), 1, 0, bow), 0.3 / 16, 1e-6);
}

TEST(Beams, ThatEndInTheBodyGoThroughNoneOfItsParts) {
  const Beams beams = two_beams({7, 0, 0}, {0, 9, 0});
  objects::Cuboid body = box_at({6, 0, 0});
  body.size.x() = 4;
  EXPECT_EQ(beams.through(box_at({5, 0, 0})), 1);
  EXPECT_EQ(beams.through(box_at({5, 0, 0}), body), 0);
}

TEST(Beams, ThatEndInABoxAreCounted) {
  const Beams beams = two_beams({5, 0, 0}, {10, 0, 0});
  EXPECT_EQ(beams.ended(box_at({5, 0, 0})), 1);
}

/// Slab by slab, in the box's frame.
bool goes_through(const objects::Cuboid& box, const Eigen::Vector3d& from,
                  const Eigen::Vector3d& to) {
  const Eigen::Vector3d a = box.pose.inverse() * from, b = box.pose.inverse() * to;
  double enter = 0, leave = 1;
  for (int k = 0; k < 3; ++k) {
    const double half = 0.5 * box.size[k], along = b[k] - a[k];
    enter = std::max(enter, std::min((-half - a[k]) / along, (half - a[k]) / along));
    leave = std::min(leave, std::max((-half - a[k]) / along, (half - a[k]) / along));
  }
  return enter < leave && leave < 1;
}

TEST(Beams, OfAnyDirectionAreFoundWhereverTheBoxIs) {
  core::Rng rng(3);
  Window window;
  window.sensors = {{0, 0, 1.5}, {1, 0, 12}, {-3, 2, 0.2}};
  for (int i = 0; i < 6000; ++i) {
    const Eigen::Vector3d end(rng.uniform(-30, 30), rng.uniform(-30, 30), rng.uniform(-2, 15));
    window.beams.push_back({end.cast<float>(), static_cast<std::uint16_t>(rng.index(3))});
  }
  Beams beams;
  beams.fill(window);
  int all = 0;
  for (int i = 0; i < 60; ++i) {
    objects::Cuboid box = box_at({rng.uniform(-15, 15), rng.uniform(-15, 15), rng.uniform(-1, 8)},
                                 rng.uniform(-3, 3));
    box.pose.rotate(Eigen::AngleAxisd(rng.uniform(-0.3, 0.3), Eigen::Vector3d::UnitX()));
    box.size = {rng.uniform(0.3, 6), rng.uniform(0.3, 3), rng.uniform(0.2, 3)};
    int expected = 0;
    for (const Beam& beam : window.beams)
      expected += goes_through(box, window.sensors[beam.scan], beam.end.cast<double>());
    EXPECT_NEAR(beams.through(box), expected, 1) << i;  // floats at the rim
    all += expected;
  }
  EXPECT_GT(all, 500);
}

}  // namespace
}  // namespace saker::detection
