#include <gtest/gtest.h>

#include "made_world.h"
#include "saker/slam/graph.h"
#include "saker/slam/landmark_estimate.h"

/// Few poor views may agree best on an object of negative size: no map can say that.
namespace saker::slam {
namespace {

using namespace made;

const LandmarkConfig kConfig;

/// Two windows on a trunk from one place: the first knows its radius by where its face is only, and
/// the second puts it 0.3 m nearer, which would make the radius −0.2 m.
Landmark contradictory() {
  Landmark landmark;
  for (int window = 0; window < 2; ++window) {
    Matrix6d covariance = 1e-4 * Matrix6d::Identity();
    covariance(5, 5) = 1;
    if (window == 0) {
      covariance(0, 0) = 1;
      covariance(0, 5) = covariance(5, 0) = 0.9999;
    }
    objects::Measurement m;
    m.class_probability = probability(kTrunk);
    m.model = objects::Cylinder{{8 - 0.3 * window, 0, 0}, Eigen::Vector3d::UnitZ(), 0.1, 3};
    m.covariance = covariance;
    const Candidate candidate{&m, {m.model, m.covariance}, m.model, 8, 0.9};
    if (window == 0) {
      landmark = new_landmark(0, candidate, 0, kConfig);
    } else {
      observe(landmark, candidate, 1, kConfig);
    }
  }
  return landmark;
}

std::vector<Keyframe> standing() {
  KeyframeConfig config;
  config.interval_s = 1;
  config.rotation_floor_deg = 1e-4;
  config.translation_floor_m = 1e-4;
  Trajectory trajectory(config);
  for (int k = 0; k < 2; ++k)
    trajectory.advance(from_seconds(k + 1), SE3::Identity(), 1e-16 * Matrix6d::Identity());
  return trajectory.keyframes();
}

GraphConfig quadratic() {
  GraphConfig config;
  config.robust_scale = 1000;
  config.iterations = 50;
  return config;
}

double radius(const Landmark& landmark) {
  return std::get<objects::Cylinder>(landmark.model).radius;
}

TEST(LeastSize, OfALandmarkOutsideTheGraphIsPositive) {
  std::vector<Keyframe> poses = standing();
  const Chain chain{&poses};
  Landmark landmark = contradictory();
  (void)refine(landmark, {&chain, 1}, quadratic());
  EXPECT_EQ(radius(landmark), kLeastSize);
}

TEST(LeastSize, OfALandmarkInTheGraphIsPositive) {
  std::vector<Keyframe> poses = standing();
  const Chain chain{&poses};
  Landmark landmark = contradictory();
  std::get<objects::Cylinder>(landmark.model).radius = 0.1;
  std::vector<Landmark*> landmarks = {&landmark};
  (void)solve_graph({&chain, 1}, landmarks, quadratic(), core::Budget::iterations(50));
  EXPECT_EQ(radius(landmark), kLeastSize);
}

}  // namespace
}  // namespace saker::slam
