#include "saker/objects/view_cell.h"

#include <gtest/gtest.h>

#include "made_world.h"
#include "saker/slam/graph.h"
#include "saker/slam/landmark_estimate.h"

/// Windows of one object from one view cell share their error: together they weigh as one.
namespace saker::slam {
namespace {

using namespace made;

const LandmarkConfig kConfig;
constexpr double kVariance = 0.04;

GraphConfig quadratic() {
  GraphConfig config;
  config.robust_scale = 1000;
  config.hidden_ends.sds = 1e9;
  config.iterations = 50;
  config.function_tolerance = 0;
  return config;
}

/// Keyframes a second apart at one place, held together by odometry that is all but sure.
std::vector<Keyframe> standing(int keyframes) {
  KeyframeConfig config;
  config.interval_s = 1;
  config.rotation_floor_deg = 1e-4;
  config.translation_floor_m = 1e-4;
  Trajectory trajectory(config);
  for (int k = 0; k < keyframes; ++k) {
    trajectory.advance(from_seconds(k + 1), SE3::Identity(), 1e-16 * Matrix6d::Identity());
  }
  return trajectory.keyframes();
}

struct Window {
  int keyframe, cell;
  double length;
};

Landmark measured(const std::vector<Window>& windows) {
  Landmark landmark;
  for (const Window& window : windows) {
    objects::Measurement m;
    m.class_probability = probability(kVehicle);
    m.model = car(8, 0, 0, window.length);
    m.covariance = kVariance * Matrix9d::Identity();
    m.view_cell = window.cell;
    const Candidate candidate{&m, {m.model, m.covariance}, m.model, 8, 0.9};
    if (landmark.id < 0) {
      landmark = new_landmark(0, candidate, window.keyframe, kConfig);
    } else {
      observe(landmark, candidate, window.keyframe, kConfig);
    }
  }
  return landmark;
}

/// Five windows from cell 2 over three keyframes, mean 4.4; one from cell 7.
std::vector<Window> two_cells() {
  return {{0, 2, 4.2}, {0, 2, 4.6}, {1, 2, 4.1}, {2, 2, 4.3}, {2, 2, 4.8}, {2, 7, 5.0}};
}

double length(const Landmark& landmark) { return std::get<Cuboid>(landmark.model).size.x(); }

TEST(ViewCell, EachCellIsWorthOneMeasurementHoweverManyWindows) {
  Landmark landmark = measured(two_cells());
  std::vector<Keyframe> poses = standing(3);
  const Chain chain{&poses};
  const Eigen::MatrixXd P = refine(landmark, {&chain, 1}, quadratic());
  EXPECT_NEAR(length(landmark), (4.4 + 5.0) / 2, 1e-6);
  EXPECT_NEAR(P(6, 6), kVariance / 2, 1e-6);
  EXPECT_NEAR(P(3, 3), kVariance / 2, 1e-6);
}

TEST(ViewCell, TheGraphWeighsTheSame) {
  std::vector<Keyframe> poses = standing(3);
  const Chain chain{&poses};
  Landmark landmark = measured(two_cells());
  std::vector<Landmark*> landmarks = {&landmark};
  (void)solve_graph({&chain, 1}, landmarks, quadratic(), core::Budget::iterations(50));
  EXPECT_NEAR(length(landmark), (4.4 + 5.0) / 2, 1e-6);
  const std::vector<const Landmark*> wanted = {&landmark};
  const CovarianceReport report = graph_covariance({&chain, 1}, landmarks, wanted, quadratic());
  ASSERT_TRUE(report.marginal);
  EXPECT_NEAR(report.covariances[0](6, 6), kVariance / 2, 1e-6);
}

TEST(ViewCell, WithoutACellEveryWindowCounts) {
  std::vector<Window> windows = two_cells();
  for (Window& window : windows) window.cell = -1;
  Landmark landmark = measured(windows);
  std::vector<Keyframe> poses = standing(3);
  const Chain chain{&poses};
  const Eigen::MatrixXd P = refine(landmark, {&chain, 1}, quadratic());
  EXPECT_NEAR(length(landmark), 27.0 / 6, 1e-6);
  EXPECT_NEAR(P(6, 6), kVariance / 6, 1e-6);
}

TEST(ViewCell, WhatMostCellsSayHoldsThoughTheFirstAndTheLastWindowSayOtherwise) {
  GraphConfig robust = quadratic();
  robust.robust_scale = GraphConfig{}.robust_scale;
  Landmark landmark = measured({{0, 2, 7.4}, {1, 7, 4.4}, {1, 9, 4.4}, {2, 2, 7.4}});
  std::vector<Keyframe> poses = standing(3);
  const Chain chain{&poses};
  (void)refine(landmark, {&chain, 1}, robust);
  EXPECT_NEAR(length(landmark), 4.4, 0.1);
}

/// By how much the cells disagree, of [rotation, translation, size].
Eigen::VectorXd scatter(const std::vector<Window>& windows) {
  Landmark landmark = measured(windows);
  std::vector<Keyframe> poses = standing(3);
  const Chain chain{&poses};
  (void)refine(landmark, {&chain, 1}, quadratic());
  return given_poses(landmark, {&chain, 1}, quadratic()).scatter;
}

TEST(ViewCell, WhereOneContradictsTheOthersTheyScatterByTheirOwnSpread) {
  // Lengths 4.4, 4.4, 5.6 m, each to 0.2 m: their mean is good to sd/√3 = 0.4 m, not to 0.115 m.
  const Eigen::VectorXd of_three = scatter({{0, 2, 4.4}, {1, 7, 4.4}, {2, 9, 5.6}});
  EXPECT_NEAR(of_three[6], 0.4 / std::sqrt(kVariance / 3), 1e-3);
  EXPECT_NEAR(of_three[7], 1, 1e-6) << "the widths agree";
}

TEST(ViewCell, ThoseThatAgreeScatterNoLessThanTheyState) {
  EXPECT_NEAR((scatter({{0, 2, 4.4}, {1, 7, 4.4}}) - Eigen::VectorXd::Ones(9)).norm(), 0, 1e-6);
}

TEST(ViewCell, OneAloneHasNothingToDisagreeWith) {
  EXPECT_EQ(scatter({{0, 2, 4.0}, {1, 2, 5.0}}), Eigen::VectorXd::Ones(9));
}

/// From behind, 1.9 m of its length stand for its width.
Window piece(int keyframe) { return {keyframe, 3, 1.9}; }

TEST(ViewCell, AWindowThatTookASideForTheLengthWeighsNothingBesideWholeOnes) {
  Landmark landmark = measured({{0, 2, 4.4}, {1, 2, 4.4}, piece(2)});
  landmark.observations[2].measured.covariance(7, 7) = 1;
  EXPECT_EQ(observation_weights(landmark, {}), (std::vector<double>{0.5, 0.5, 0}));
  landmark.observations[2].measured.covariance(6, 6) = 4;
  EXPECT_EQ(observation_weights(landmark, {}), (std::vector<double>{0.5, 0.5, 1}));
}

TEST(ViewCell, WhereNoWindowKnowsTheWidthNoneIsLeftOut) {
  Landmark landmark = measured({{0, 2, 4.4}, {1, 2, 4.4}, piece(2)});
  for (Observation& o : landmark.observations) o.measured.covariance(7, 7) = 1;
  EXPECT_EQ(observation_weights(landmark, {}), (std::vector<double>{0.5, 0.5, 1}));
}

/// Its longer side lies across: two neighbours' tails taken for one vehicle.
void turn_across(Observation& observation) {
  std::swap(std::get<Cuboid>(observation.measured.model).size.x(),
            std::get<Cuboid>(observation.measured.model).size.y());
}

TEST(ViewCell, ManyWindowsOfOneViewDoNotOutvoteTwoViews) {
  Landmark landmark = measured({{0, 3, 4.4}, {1, 3, 4.4}, {2, 3, 4.4}, {0, 7, 4.4}, {1, 9, 4.4}});
  for (Observation& o : landmark.observations) {
    if (o.cell == 3) turn_across(o);
  }
  std::vector<double> weights;
  for (const Observation& o : landmark.observations) weights.push_back(o.cell == 3 ? 0 : 1);
  EXPECT_EQ(observation_weights(landmark, {}), weights);
}

TEST(ViewCell, AShortWindowMayHideAnEndUnlessTheModelCorrectedIt) {
  std::vector<Keyframe> poses = standing(2);
  const Chain chain{&poses};
  GraphConfig config = quadratic();
  config.hidden_ends.sds = 1;
  Landmark corrected =
      measured({{0, objects::corrected_cell(1), 4.4}, {1, objects::corrected_cell(2), 3.4}});
  (void)refine(corrected, {&chain, 1}, config);
  EXPECT_NEAR(length(corrected), 3.9, 1e-6);
  Landmark hidden =
      measured({{0, objects::uncorrected_cell(1), 4.4}, {1, objects::uncorrected_cell(2), 3.4}});
  (void)refine(hidden, {&chain, 1}, config);
  EXPECT_GT(length(hidden), 4.1);
}

TEST(ViewCell, AnOutlierOfACellStaysOne) {
  std::vector<Window> windows(9, {0, 2, 4.4});
  for (int k = 0; k < 9; ++k) windows[static_cast<std::size_t>(k)].keyframe = k;
  windows.push_back({9, 2, 12.4});  // 40 sd of a window, 13 sd of one window in ten
  Landmark landmark = measured(windows);
  GraphConfig config = quadratic();
  config.robust_scale = 3;
  std::vector<Keyframe> poses = standing(10);
  const Chain chain{&poses};
  (void)refine(landmark, {&chain, 1}, config);
  EXPECT_NEAR(length(landmark), 4.4, 0.02);
}

TEST(ViewCell, WhatIsHandedOverStaysInItsCell) {
  Landmark landmark = measured(two_cells());
  std::vector<Keyframe> poses = standing(3);
  const Chain chain{&poses};
  (void)refine(landmark, {&chain, 1}, quadratic());
  hand_over(landmark, poses[1], poses[0], quadratic());
  EXPECT_EQ(observation_weights(landmark, {}), (std::vector<double>{0.6, 0.4, 1}));
  (void)refine(landmark, {&chain, 1}, quadratic());
  EXPECT_NEAR(length(landmark), (4.4 + 5.0) / 2, 1e-6);
}

TEST(ViewCell, AFittedLengthDoesNotHideThatBothEndsWereSeen) {
  objects::Measurement m;
  m.class_probability = probability(kVehicle);
  m.model = car(8, 0, 0);
  m.covariance = 0.25 * Matrix9d::Identity();  // what a cell's windows err by
  m.length_sd = 0.1;
  const Candidate candidate{&m, {m.model, m.covariance}, m.model, 8, 0.9};
  EXPECT_NEAR(new_landmark(0, candidate, 0, kConfig).ends[0].best.norm(), 0.1, 1e-12);
}

TEST(ViewCell, MergedLandmarksHaveTheEndsThatEitherSaw) {
  Landmark a = measured({{0, 2, 4.4}});
  EXPECT_FALSE(std::isfinite(a.ends[0].next.norm()));
  absorb(a, measured({{1, 2, 4.4}}));
  EXPECT_NEAR(a.ends[0].next.norm(), a.ends[0].best.norm(), 1e-12);
}

TEST(ViewCell, MergedLandmarksShareTheirCells) {
  Landmark a = measured({{0, 2, 4.4}, {1, 2, 4.4}});
  absorb(a, measured({{1, 2, 4.6}, {1, 2, 4.6}, {2, 3, 4.4}}));
  ASSERT_EQ(a.observations.size(), 3U);
  EXPECT_EQ(a.observations[1].windows, 3);
  EXPECT_NEAR(std::get<Cuboid>(a.observations[1].measured.model).size.x(), 13.6 / 3, 1e-6);
  EXPECT_NEAR(a.observations[1].measured.covariance(6, 6), kVariance, 1e-6);
  EXPECT_EQ(observation_weights(a, {}), (std::vector<double>{0.25, 0.75, 1}));
}

}  // namespace
}  // namespace saker::slam
