#include "saker/detection/face_fitter.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "made_scene.h"
#include "saker/detection/size_prior.h"

namespace saker::detection {
namespace {

using testing::MadeBox;

constexpr double kHighest = 2.6;  // m

/// For boxes, whose faces do not bow.
FaceConfig flat() {
  FaceConfig config;
  config.bow_end_m = config.bow_side_m = 0;
  return config;
}

/// A box seen from one place, its places as few as are not thinned.
struct BoxView {
  Eigen::Vector3d sensor;
  MadeBox box;
  double noise = 0.02;
  std::vector<Eigen::Vector3d> hits = {};  ///< where beams end on it
  Places places = {};
  Surroundings surroundings{{}};

  BoxView(const Eigen::Vector3d& from, const MadeBox& seen, double sd = 0.02)
      : sensor(from), box(seen), noise(sd) {
    core::Rng rng(3);
    hits = testing::visible_box(box, sensor, 1100, noise, rng);
    for (const Eigen::Vector3d& p : hits) {
      if (p.z() > 0.2) places.emplace_back(p.head<2>());
    }
  }

  [[nodiscard]] Plan fit() const {
    const Beams beams = testing::ground_beams(sensor, {box}, 4000, hits);
    const Sight sight{{sensor}, beams, surroundings, SE3::Identity()};
    const VehicleView view{places, static_cast<int>(places.size()), box.height, sight};
    const FaceFitter fitter(flat(), kHighest, vehicle_kinds({}));
    return fitter.fit(view, fitter.outline(view));
  }

  [[nodiscard]] Plan outline() const {
    const Beams beams;
    const Sight sight{{sensor}, beams, surroundings, SE3::Identity()};
    const VehicleView view{places, static_cast<int>(places.size()), box.height, sight};
    return FaceFitter(flat(), kHighest, vehicle_kinds({})).outline(view);
  }
};

double off(double heading, double yaw) { return std::abs(std::remainder(heading - yaw, M_PI)); }

Eigen::Vector2d middle(const Plan& plan) {
  return Eigen::Rotation2Dd(plan.heading) *
         Eigen::Vector2d(plan.axis[0].centre(), plan.axis[1].centre());
}

const Eigen::Vector3d kAbove(0, 0, 6);  // sees two sides and the roof
const Eigen::Vector3d kLow(0, 0, 1.2);

TEST(FaceFitter, OutlineOfABoxIsItsRectangleTheLongerSideFirst) {
  for (const double yaw : {0.3, 1.2, 2.3, -0.8}) {
    const Plan plan = BoxView(kAbove, {9, 2, yaw}).outline();
    EXPECT_LT(off(plan.heading, yaw), 0.06) << yaw;
    EXPECT_NEAR(plan.axis[0].size(), 4.5, 0.15) << yaw;
    EXPECT_NEAR(plan.axis[1].size(), 1.8, 0.15) << yaw;
    EXPECT_LT((middle(plan) - Eigen::Vector2d(9, 2)).norm(), 0.12) << yaw;
  }
}

TEST(FaceFitter, OutlineTellsHowWellItKnowsTheHeading) {
  int within = 0;
  for (int i = 0; i < 12; ++i) {
    const double yaw = 0.25 * i;
    const Plan plan = BoxView(kAbove, {9, 2, yaw}, 0.03).outline();
    EXPECT_LT(plan.heading_sd, 0.05) << yaw;
    within += off(plan.heading, yaw) < 2 * plan.heading_sd;
  }
  EXPECT_GE(within, 10);
}

TEST(FaceFitter, OutlineDoesNotDependOnTheOrderOfThePlaces) {
  BoxView view(kAbove, {9, 2, 0.4});
  const Plan before = view.outline();
  std::ranges::reverse(view.places);
  const Plan after = view.outline();
  EXPECT_NEAR(after.heading, before.heading, 1e-3);
  for (int k = 0; k < 2; ++k) EXPECT_NEAR(after.axis[k].size(), before.axis[k].size(), 0.02);
}

TEST(FaceFitter, FindsTheFacesThatWereSeen) {
  for (const double yaw : {0.4, 1.2, -0.8}) {
    const Plan plan = BoxView(kAbove, {9, 2, yaw}).fit();
    EXPECT_LT(off(plan.heading, yaw), 0.02) << yaw;
    EXPECT_NEAR(plan.axis[0].size(), 4.5, 0.35) << yaw;
    EXPECT_NEAR(plan.axis[1].size(), 1.8, 0.15) << yaw;
    EXPECT_FALSE(plan.several) << yaw;
  }
}

TEST(FaceFitter, CovariancesAreSymmetricAndPositive) {
  for (const Eigen::Vector3d& sensor : {kAbove, kLow}) {
    const Plan plan = BoxView(sensor, {9, 2, 0.6}).fit();
    for (const Extent& extent : plan.axis) {
      EXPECT_NEAR(extent.covariance(0, 1), extent.covariance(1, 0), 1e-12);
      EXPECT_GT(extent.covariance.selfadjointView<Eigen::Lower>().eigenvalues().minCoeff(), 0);
    }
  }
}

TEST(FaceFitter, PlanTurnsWithTheScene) {
  const Plan before = BoxView(kAbove, {9, 0, 0.5}).fit();
  for (const double turn : {0.35, -0.45}) {
    const MadeBox turned{9 * std::cos(turn), 9 * std::sin(turn), 0.5 + turn};
    const Plan after = BoxView(kAbove, turned).fit();
    EXPECT_LT(off(after.heading, before.heading + turn), 0.02) << turn;
    EXPECT_NEAR(after.axis[0].size(), before.axis[0].size(), 0.15) << turn;
    EXPECT_NEAR(after.axis[1].size(), before.axis[1].size(), 0.1) << turn;
  }
}

TEST(FaceFitter, FaceThatWasSeenIsBetterKnownThanTheOneBehind) {
  // From behind and low: its rear is seen, its front is not.
  const Plan plan = BoxView(kLow, {12, 0, 0}).fit();
  Eigen::Matrix2d to_edges;
  to_edges << 1, -0.5, 1, 0.5;
  const Eigen::Matrix2d edges = to_edges * plan.axis[0].covariance * to_edges.transpose();
  const bool forward = std::cos(plan.heading) > 0;
  const double rear = std::sqrt(edges(forward ? 0 : 1, forward ? 0 : 1));
  const double front = std::sqrt(edges(forward ? 1 : 0, forward ? 1 : 0));
  EXPECT_LT(rear, 0.15);
  EXPECT_GT(front, 3 * rear);
  EXPECT_NEAR(forward ? plan.axis[0].low : -plan.axis[0].high, 9.75, 0.12);
}

TEST(FaceFitter, RowAsLongAsTwoCarsAndNoHigherIsSeveral) {
  EXPECT_TRUE(BoxView({0, -8, 1.2}, {0, 0, 0, 9.2, 1.85, 1.5}).fit().several);
  EXPECT_FALSE(BoxView({0, -8, 1.2}, {0, 0, 0, 4.6, 1.85, 1.5}).fit().several);
}

TEST(FaceFitter, NoisierPlacesMakeWiderFaces) {
  const auto variance = [](double noise) {
    return BoxView(kAbove, {9, 2, 0.4}, noise).fit().axis[1].covariance(1, 1);
  };
  EXPECT_GT(variance(0.08), variance(0.01));
}

}  // namespace
}  // namespace saker::detection
