#include "saker/segmentation/ground_height.h"

#include <gtest/gtest.h>

#include <numbers>

#include "lidar/made_scan.h"

namespace saker::segmentation {
namespace {

using lidar::testing::MadeScan;

struct Made {
  RangeImage image;
  GroundHeight ground;
  Eigen::Quaternionf tilt;
  float sensor_m;

  explicit Made(const MadeScan& scan, const Eigen::Vector3f& up = Eigen::Vector3f::UnitZ())
      : ground(up), tilt(scan.tilt), sensor_m(scan.height_m) {
    project(scan.organised(), image);
    estimate();
  }
  void estimate() {
    BeamSpacing spacing;
    spacing.measure(image);
    ground.estimate(image, spacing);
  }
  [[nodiscard]] float true_height(std::size_t i) const {
    return (tilt * image.points[i]).z() + sensor_m;
  }
};

/// Largest error of the height over pixels within the distance.
float worst(const Made& made, float distance_m) {
  float error = 0;
  for (std::size_t i = 0; i < made.image.size(); ++i) {
    if (!made.image.valid(i) || made.image.range[i] > distance_m) continue;
    error = std::max(error, std::abs(made.ground.height()[i] - made.true_height(i)));
  }
  return error;
}

class GroundHeightAt : public ::testing::TestWithParam<std::tuple<float, float>> {};

TEST_P(GroundHeightAt, IsTheHeightOverAFlatGroundWhateverTheSensorsHeightAndTilt) {
  const auto [height, tilt] = GetParam();
  const Eigen::Vector3f axis = Eigen::Vector3f(1, 0.5F, 0).normalized();
  const Made made({.height_m = height,
                   .wall_m = 30,
                   .tilt = Eigen::Quaternionf(Eigen::AngleAxisf(tilt, axis))});
  EXPECT_GT((made.tilt * made.ground.up()).z(), std::cos(0.02F));
  EXPECT_LT(worst(made, 25), 0.25F);
}

INSTANTIATE_TEST_SUITE_P(Sensors, GroundHeightAt,
                         ::testing::Combine(::testing::Values(1.2F, 1.7F, 4.0F, 8.0F),
                                            ::testing::Values(0.0F, 0.1F, 0.25F)));

/// As mounted: while the vehicle leans by a tenth of a radian besides.
TEST(GroundHeight, OfASensorOnItsSideAt30MetresIsFoundFromWhereUpIsAsMounted) {
  constexpr float kSide = std::numbers::pi_v<float> / 2;
  const Eigen::Quaternionf mounted(Eigen::AngleAxisf(kSide, Eigen::Vector3f::UnitX()));
  const Eigen::Quaternionf lean(Eigen::AngleAxisf(0.1F, Eigen::Vector3f(0.6F, 0.8F, 0)));
  const Made made({.height_m = 30, .wall_m = 300, .tilt = lean * mounted},
                  mounted.inverse() * Eigen::Vector3f::UnitZ());
  EXPECT_GT((made.tilt * made.ground.up()).z(), std::cos(0.02F));
  EXPECT_LT(worst(made, 60), 0.25F);
}

TEST(GroundHeight, IsNotPulledDownByReflectionsFromBelow) {
  MadeScan scan;
  Made made(scan);
  for (std::size_t i = 40; i < 44; ++i) {  // a few mirrored points in a row, 12 m below the ground
    const std::size_t pixel = 40 * 1024 + i;
    made.image.points[pixel] = {-30, 1, -14};
    made.image.range[pixel] = made.image.points[pixel].norm();
  }
  made.estimate();
  for (std::size_t i = 63 * 1024; i < 64 * 1024; ++i) EXPECT_NEAR(made.ground.height()[i], 0, 0.1);
}

TEST(GroundHeight, IsNotPulledDownByAFewReflectionsCloseBy) {
  Made made(MadeScan{});
  const Eigen::Vector3f mirrored(6, -2, -3.2F);  // 1.2 m below the ground
  for (std::size_t i = 0; i < 6; ++i) {
    const std::size_t pixel = 50 * 1024 + 560 + i;
    made.image.points[pixel] = mirrored + Eigen::Vector3f(0, 0.03F * static_cast<float>(i), 0);
    made.image.range[pixel] = made.image.points[pixel].norm();
  }
  made.estimate();
  for (std::size_t i = 45 * 1024; i < made.image.size(); ++i) {
    if (made.image.points[i].z() > -2.1F) {
      ASSERT_NEAR(made.ground.height()[i], 0, 0.1);
    }
  }
}

TEST(GroundHeight, OfAnImageOfNothingIsZero) {
  const Made made({.height_m = 1000, .wall_m = 1e6F});
  for (const float h : made.ground.height()) ASSERT_TRUE(std::isfinite(h));
}

}  // namespace
}  // namespace saker::segmentation
