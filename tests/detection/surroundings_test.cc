#include "saker/detection/surroundings.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>

#include "saker/core/rng.h"

namespace saker::detection {
namespace {

using Points = std::vector<Eigen::Vector3f>;

/// Level, 12 m to each side.
Ground level_ground() {
  Points points;
  for (float x = -12; x <= 12; x += 0.25f) {
    for (float y = -12; y <= 12; y += 0.25f) points.emplace_back(x, y, 0);
  }
  Ground ground({});
  ground.fit(points, {}, 20);
  return ground;
}

Surroundings filled(const Points& others, int stride = 1) {
  static const Ground ground = level_ground();
  Surroundings surroundings({});
  surroundings.fill(others, stride, ground);
  return surroundings;
}

const Eigen::Vector2f kFoot(5, 3);
constexpr double kRadius = 0.2;

objects::Cylinder trunk() { return {{5, 3, 0}, Eigen::Vector3d::UnitZ(), kRadius, 3}; }

/// At a distance from the foot and a height.
Eigen::Vector3f beside(float distance, float height, float angle = 0.4f) {
  return {kFoot.x() + distance * std::cos(angle), kFoot.y() + distance * std::sin(angle), height};
}

TEST(Surroundings, OfATrunkStandInARingAroundIt) {
  EXPECT_EQ(filled({beside(0.25f, 1)}).around(kFoot, kRadius), 0) << "of the trunk itself";
  EXPECT_EQ(filled({beside(0.5f, 1)}).around(kFoot, kRadius), 1);
  EXPECT_EQ(filled({beside(0.9f, 1)}).around(kFoot, kRadius), 0) << "beyond the ring";
}

TEST(Surroundings, OfAThickerTrunkStandFartherOut) {
  EXPECT_EQ(filled({beside(0.9f, 1)}).around(kFoot, 0.5), 1);
  EXPECT_EQ(filled({beside(0.5f, 1)}).around(kFoot, 0.5), 0);
}

TEST(Surroundings, GrassAndCrownStandInNoRing) {
  EXPECT_EQ(filled({beside(0.5f, 0.1f), beside(0.5f, 2.5f)}).around(kFoot, kRadius), 0);
}

TEST(Surroundings, CountThePointsThatWereLeftOutToo) {
  const Points others = {beside(0.5f, 1), beside(0.6f, 1.2f)};
  EXPECT_EQ(filled(others, 5).around(kFoot, kRadius), 5 * filled(others).around(kFoot, kRadius));
}

TEST(Surroundings, WhereNoGroundWasSeenAreNotKnown) {
  const Eigen::Vector3f far(60, 0, 1);
  EXPECT_EQ(filled({far}).around({60.5f, 0}, kRadius), 0);
}

TEST(Surroundings, InsideACylinderAreThoseWithinItsSurface) {
  EXPECT_EQ(filled({beside(0.1f, 1), beside(0.25f, 1), beside(0.35f, 1)}).inside(trunk()), 2);
}

TEST(Surroundings, InsideACuboidLieBetweenItsFacesHoweverItIsTurned) {
  for (const double yaw : {0.0, 0.6, 2.0, -1.2}) {
    objects::Cuboid box{SE3::Identity(), {4.5, 1.8, 1.5}};
    box.pose.translation() << -3, 2, 0.75;
    box.pose.rotate(Eigen::AngleAxisd(yaw, Eigen::Vector3d::UnitZ()));
    const auto at = [&](double x, double y) -> Eigen::Vector3f {
      return (box.pose * Eigen::Vector3d(x, y, 0)).cast<float>();
    };
    EXPECT_EQ(filled({at(2.2, 0.8), at(-2.2, -0.8), at(0, 0)}).inside(box), 3) << yaw;
    EXPECT_EQ(filled({at(2.3, 0), at(0, 0.95), at(-2.3, 0), at(0, -0.95)}).inside(box), 0) << yaw;
  }
}

/// The grid they are kept on changes no count.
TEST(Surroundings, AreCountedAsByOneLookAtEachPoint) {
  core::Rng rng(4);
  Points others;
  for (int i = 0; i < 3000; ++i) {
    others.push_back(
        Eigen::Vector3d(rng.uniform(-8, 8), rng.uniform(-8, 8), rng.uniform(0, 3)).cast<float>());
  }
  const Surroundings surroundings = filled(others);
  const SurroundingsConfig config;
  for (int i = 0; i < 50; ++i) {
    const Eigen::Vector2f foot(static_cast<float>(rng.uniform(-7, 7)),
                               static_cast<float>(rng.uniform(-7, 7)));
    int expected = 0;
    for (const Eigen::Vector3f& p : others) {
      const double off = (p.head<2>() - foot).norm() - kRadius - config.gap_m;
      expected +=
          p.z() > config.lowest_m && p.z() < config.highest_m && off > 0 && off < config.width_m;
    }
    EXPECT_NEAR(surroundings.around(foot, kRadius), expected, 1) << i;  // floats at the rim
  }
}

/// Leaves 1 m from the axis, as many as a share of a trunk's 100 points.
double odds_by(double share) {
  Points leaves;
  for (int i = 0; i < static_cast<int>(100 * share); ++i) {
    leaves.push_back(beside(1, 3, 0.1f * static_cast<float>(i)));
  }
  return filled(leaves).crown_odds(trunk(), 100);
}

TEST(Surroundings, LeavesAboveSpeakForATrunkTheirLackForAPole) {
  const SurroundingsConfig config;
  EXPECT_DOUBLE_EQ(odds_by(0), 1 / config.bare_odds);
  EXPECT_DOUBLE_EQ(odds_by(config.bare_share - 0.1), 1 / config.bare_odds);
  EXPECT_DOUBLE_EQ(odds_by(0.5 * (config.bare_share + config.leafy_share)), 1);
  EXPECT_DOUBLE_EQ(odds_by(config.leafy_share + 0.1), config.leafy_odds);
}

TEST(Surroundings, ABushBesideATrunkAndATreeFartherOffAreNoCrownOfIt) {
  EXPECT_LT(filled(Points(300, beside(1, 1))).crown_odds(trunk(), 100), 1);
  EXPECT_LT(filled(Points(300, beside(2, 3))).crown_odds(trunk(), 100), 1);
  EXPECT_LT(filled(Points(300, beside(1, 9))).crown_odds(trunk(), 100), 1);
}

TEST(Surroundings, AreThoseOfTheLastFill) {
  const Ground ground = level_ground();
  Surroundings surroundings({});
  surroundings.fill(Points(7, beside(0.5f, 1)), 1, ground);
  surroundings.fill(Points(2, beside(0.5f, 1)), 1, ground);
  EXPECT_EQ(surroundings.around(kFoot, kRadius), 2);
  surroundings.fill({}, 1, ground);
  EXPECT_EQ(surroundings.around(kFoot, kRadius), 0);
}

}  // namespace
}  // namespace saker::detection
