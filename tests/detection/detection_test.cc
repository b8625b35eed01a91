#include "detection/detection.h"

#include <gtest/gtest.h>

#include "core/error.h"
#include "made_scene.h"

namespace saker::detection {
namespace {

using testing::SceneBuilder;

/// A parked vehicle, a trunk and a pole on a slope, seen from a sensor that flies by, tilted.
std::vector<LabelledScan> flight(double slope) {
  std::vector<LabelledScan> scans;
  core::Rng rng(11);
  for (int i = 0; i < 10; ++i) {
    SE3 T = SE3::Identity();
    T.translation() = Eigen::Vector3d(0.3 * i, 0, 4);
    T.linear() = Eigen::AngleAxisd(0.15, Eigen::Vector3d::UnitY()).toRotationMatrix();
    SceneBuilder scene;
    scene.add_ground(slope, 30, rng);
    auto box = testing::visible_box({9, 4, 0.5}, T.translation(), 400, 0.02, rng);
    for (auto& p : box) p.z() += slope * p.x();
    scene.add(box, 1);
    scene.add(testing::visible_cylinder({6, -5, 6 * slope}, {0, 0, 1}, 0.2, 3, T.translation(), 60,
                                        0.02, rng),
              2);
    scene.add(testing::visible_cylinder({12, -3, 12 * slope}, {0, 0, 1}, 0.08, 5, T.translation(),
                                        40, 0.02, rng),
              3);
    scans.push_back(scene.scan(0.1 * i, T));
  }
  return scans;
}

TEST(Detection, FindsEachObjectOnceInTheLastScansFrame) {
  for (const double slope : {0.0, 0.1}) {
    const auto scans = flight(slope);
    Detection detection({}, {});
    const auto result = detection.detect(scans);
    ASSERT_EQ(result.measurements.size(), 3u) << slope;
    EXPECT_EQ(result.stamp, scans.back().stamp);
    const SE3& T = scans.back().T_odom_lidar;
    const std::vector<Eigen::Vector3d> truth = {
        {9, 4, 9 * slope + 0.75}, {6, -5, 6 * slope}, {12, -3, 12 * slope}};
    for (int i = 0; i < 3; ++i) {
      EXPECT_EQ(result.measurements[i].class_id, i + 1);
      EXPECT_FALSE(result.measurements[i].moving);
      EXPECT_LT((T * objects::place(result.measurements[i].model) - truth[i]).norm(), 0.2) << i;
    }
  }
}

TEST(Detection, IsTheSameToTheByteEachTime) {
  const auto scans = flight(0.05);
  Detection used({}, {});
  (void)used.detect(std::span(scans).first(3));
  Detection fresh({}, {});
  const auto a = used.detect(scans);
  const auto b = fresh.detect(scans);
  ASSERT_EQ(a.measurements.size(), b.measurements.size());
  for (std::size_t i = 0; i < a.measurements.size(); ++i) {
    EXPECT_EQ(objects::place(a.measurements[i].model), objects::place(b.measurements[i].model));
    EXPECT_EQ(a.measurements[i].covariance, b.measurements[i].covariance);
  }
}

TEST(Detection, GoesOnWithNothingNaNAndMissingLabels) {
  Detection detection({}, {});
  EXPECT_TRUE(detection.detect({}).measurements.empty());
  LabelledScan empty;
  EXPECT_TRUE(detection.detect({&empty, 1}).measurements.empty());
  SceneBuilder scene;
  scene.add(std::vector<Eigen::Vector3d>(200, Eigen::Vector3d::Constant(NAN)), 1);
  scene.add(std::vector<Eigen::Vector3d>(200, Eigen::Vector3d::Constant(NAN)), 4);
  const LabelledScan nan = scene.scan(0, SE3::Identity());
  EXPECT_TRUE(detection.detect({&nan, 1}).measurements.empty());
}

TEST(Detection, SaysClassProbabilitiesThatSumToOne) {
  const auto scans = flight(0);
  Detection detection({}, {});
  for (const auto& m : detection.detect(scans).measurements) {
    double sum = 0;
    for (const double p : m.class_probability) sum += p;
    EXPECT_NEAR(sum, 1, 1e-9);
    EXPECT_NEAR(m.class_probability[m.class_id], 0.9, 1e-6);
  }
}

TEST(Detection, RefusesAnInvalidConfiguration) {
  DetectionConfig config;
  config.vehicle_clusters.reach_m = -1;
  EXPECT_THROW(Detection(config, {}), Error);
}

}  // namespace
}  // namespace saker::detection
