#include "saker/lidar/beam_sharpness.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <limits>

#include "made_scan.h"

namespace saker::lidar {
namespace {

constexpr float kBin = 0.00105F;

SensorPose pose_at(float x, float y, float z, float roll = 0, float pitch = 0) {
  SensorPose pose;
  pose << x, y, z, roll, pitch;
  return pose;
}

/// Of a sensor at x 0.8, z 1.9 m in the recording's frame.
const SensorPose kTruth = pose_at(0.8F, 0, 1.9F);
std::vector<Eigen::Vector3f> points() {
  const Eigen::Isometry3f T(Eigen::Translation3f(kTruth.head<3>()));
  return testing::scan_in(T).points;
}

TEST(SensorAxis, IsTheZAxisTurnedByRollThenPitch) {
  EXPECT_TRUE(sensor_axis(SensorPose::Zero()).isApprox(Eigen::Vector3f::UnitZ()));
  for (const float roll : {-0.1F, 0.0F, 0.05F}) {
    for (const float pitch : {-0.07F, 0.0F, 0.1F}) {
      const Eigen::Vector3f z =
          Eigen::AngleAxisf(pitch, Eigen::Vector3f::UnitY()) *
          (Eigen::AngleAxisf(roll, Eigen::Vector3f::UnitX()) * Eigen::Vector3f::UnitZ());
      EXPECT_TRUE(sensor_axis(pose_at(1, 2, 3, roll, pitch)).isApprox(z, 1e-6F));
    }
  }
}

TEST(BeamSharpness, IsGreatestWhereTheBeamsStart) {
  const BeamSharpness beams(points());
  const float at_truth = beams.whole(kTruth, kBin);
  EXPECT_GT(at_truth, 0.5F);
  for (const SensorPose& away :
       {pose_at(0, 0, 0), pose_at(0.8F, 0, 1.4F), pose_at(0.8F, 0, 2.4F), pose_at(1.6F, 0, 1.9F),
        pose_at(0.8F, 0.8F, 1.9F), pose_at(0.8F, 0, 1.9F, 0.05F, 0)}) {
    EXPECT_LT(beams.whole(away, kBin), at_truth - 0.1F) << away.transpose();
  }
}

TEST(BeamSharpness, InSectorsHardlyMindsATilt) {
  const BeamSharpness beams(points());
  const SensorPose tilted = pose_at(0.8F, 0, 1.9F, 0.005F, 0);
  const float lost_in_sectors = beams.by_sector(kTruth, kBin) - beams.by_sector(tilted, kBin);
  EXPECT_LT(lost_in_sectors, (beams.whole(kTruth, kBin) - beams.whole(tilted, kBin)) / 2);
}

TEST(BeamSharpness, FewPointsLieBetweenTheBeamsOfOneSensorAndManyElsewhere) {
  const BeamSharpness beams(points());
  EXPECT_LT(beams.share_between_beams(kTruth, kBin), 0.1F);
  EXPECT_GT(beams.share_between_beams(pose_at(0, 0, 0), kBin), 0.2F);
}

TEST(BeamSharpness, FewPointsTellNothing) {
  auto few = points();
  few.resize(1999);
  EXPECT_TRUE(BeamSharpness(few).empty());
  EXPECT_TRUE(BeamSharpness({}).empty());
  EXPECT_FALSE(BeamSharpness(points()).empty());
}

TEST(BeamSharpness, NumbersThatAreNoPlacesDoNotMatter) {
  auto damaged = points();
  const BeamSharpness beams(damaged);
  constexpr float kMost = std::numeric_limits<float>::max();
  for (const float bad : {NAN, INFINITY, kMost, -kMost, 1e25F}) {
    damaged.insert(damaged.begin() + 100, Eigen::Vector3f(bad, bad, bad));
    damaged.insert(damaged.begin() + 999, Eigen::Vector3f(0, bad, bad));
  }
  const BeamSharpness again(damaged);
  EXPECT_EQ(again.whole(kTruth, kBin), beams.whole(kTruth, kBin));
  EXPECT_EQ(again.by_sector(kTruth, kBin), beams.by_sector(kTruth, kBin));
}

}  // namespace
}  // namespace saker::lidar
