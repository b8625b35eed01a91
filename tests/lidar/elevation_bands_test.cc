#include "saker/lidar/elevation_bands.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "made_scan.h"

namespace saker::lidar {
namespace {

using testing::MadeScan;
using testing::ring_by_ring;
using testing::RingFile;
using testing::uneven_elevations;

constexpr float kStep = 2 * std::numbers::pi_v<float> / 1024;

struct Angles {
  std::vector<float> azimuth, elevation;

  explicit Angles(const std::vector<Eigen::Vector3f>& points) {
    for (const Eigen::Vector3f& p : points) {
      azimuth.push_back(std::atan2(p.y(), p.x()));
      elevation.push_back(std::asin(p.z() / p.norm()));
    }
  }
  [[nodiscard]] ElevationBands bands() const {
    return find_elevation_bands(azimuth, elevation, kStep, 140);
  }
};

RingFile uneven_file() {
  const MadeScan sensor{.wall_m = 8, .elevation_deg = uneven_elevations()};
  return shuffled(ring_by_ring(sensor.organised()), 1);
}

int rows_of(const RingFile& file) {
  return 64 - *std::min_element(file.row.begin(), file.row.end());
}

TEST(ElevationBands, AreAsManyAsBeamsHoweverUnevenlyTheyLie) {
  const RingFile file = uneven_file();
  EXPECT_EQ(Angles(file.scan.points).bands().count(), rows_of(file));
}

TEST(ElevationBands, AreNotStretchedByPointsFarOff) {
  RingFile file = uneven_file();
  for (const float z : {-30.0F, -9.0F, 40.0F}) file.scan.points.emplace_back(3, 1, z);
  const int count = Angles(file.scan.points).bands().count();
  EXPECT_GE(count, rows_of(file));
  EXPECT_LE(count, rows_of(file) + 3);
}

/// Compensated for the motion of 1 m a turn, points lie in the sensor's frame at the end of it.
TEST(ElevationBands, StayAsManyWhereTheMotionHasBlurredTheRings) {
  RingFile file = uneven_file();
  for (Eigen::Vector3f& p : file.scan.points) {
    const float turn = 0.5F - std::atan2(p.y(), p.x()) / (2 * std::numbers::pi_v<float>);
    p.x() += 1 - turn;
  }
  EXPECT_NEAR(Angles(file.scan.points).bands().count(), rows_of(file), 8);
}

TEST(ElevationBands, TakeSecondReturnsOfABeamForTheSameBeam) {
  RingFile file = uneven_file();
  const std::size_t once = file.scan.size();
  for (std::size_t i = 0; i < once; i += 4) file.scan.points.push_back(1.3F * file.scan.points[i]);
  EXPECT_EQ(Angles(file.scan.points).bands().count(), rows_of(file));
}

TEST(ElevationBands, OfFewPointsAreAtLeastOne) {
  const Angles angles({{5, 0, 0}, {0, 5, 0.1F}});
  const ElevationBands bands = angles.bands();
  EXPECT_GE(bands.count(), 1);
  EXPECT_EQ(bands.of(-1.5F), bands.count() - 1);
  EXPECT_EQ(bands.of(1.5F), 0);
}

TEST(ElevationBands, AreMergedToTheMostThatIsAskedFor) {
  const Angles angles(uneven_file().scan.points);
  EXPECT_LE(find_elevation_bands(angles.azimuth, angles.elevation, kStep, 20).count(), 20);
}

TEST(AzimuthStep, IsFoundFromThePointsAlone) {
  const Angles angles(uneven_file().scan.points);
  EXPECT_NEAR(find_azimuth_step(angles.azimuth, angles.elevation), kStep, 0.02F * kStep);
}

TEST(AzimuthStep, OfFewPointsIsNotKnown) {
  const Angles angles({{5, 0, 0}, {0, 5, 0.1F}});
  EXPECT_EQ(find_azimuth_step(angles.azimuth, angles.elevation), 0);
}

}  // namespace
}  // namespace saker::lidar
