#include "saker/simulation/sensor/scanner.h"

#include <gtest/gtest.h>

namespace saker::simulation {
namespace {

constexpr double kHeight = 2;

/// A plain of one material, 2 m under the sensor.
World plain(const Material& material) {
  World world;
  const MaterialId id = world.add(material);
  Pen(world.mesh).quad({-200, -200, 0}, {200, -200, 0}, {200, 200, 0}, {-200, 200, 0}, id);
  return world;
}

ReceiverConfig ideal() {
  ReceiverConfig config;
  config.noise_m = config.noise_per_m = config.beam_bias_m = config.divergence_mrad = 0;
  config.mixed_share = config.drop_share = 0;
  config.sensitivity = 1e-12;
  return config;
}

BeamTable os1(int columns = 512) {
  return ouster_beams(lidar::SensorInfo::make_os1(64, columns, lidar::PacketProfile::kLegacy));
}

const Material kMatt{kRoad, 0.3F, 0, 0, 0, 0};

CastScan scan_of(const World& world, const ReceiverConfig& config, std::uint64_t seed = 1) {
  const RayCaster caster(world);
  const Scanner scanner(caster, world, os1(), config, seed);
  return scanner.cast([](int) { return placed(0, 0, kHeight); }, 0);
}

TEST(Scanner, WithoutNoiseEveryPointLiesOnThePlain) {
  const CastScan scan = scan_of(plain(kMatt), ideal());
  int returns = 0;
  for (std::size_t i = 0; i < scan.points.size(); ++i) {
    if (scan.range_m[i] <= 0) continue;
    ++returns;
    EXPECT_NEAR(scan.points[i].z(), -kHeight, 1e-3);
    EXPECT_EQ(scan.labels[i], kRoad);
  }
  EXPECT_GT(returns, 30 * 512);  // nearly all beams below the horizon
}

TEST(Scanner, ABeamWithoutReturnIsNaNAndZero) {
  const CastScan scan = scan_of(plain(kMatt), ideal());
  EXPECT_EQ(scan.range_m[0], 0);  // 22.5° up
  EXPECT_TRUE(std::isnan(scan.points[0].x()));
}

TEST(Scanner, RangeNoiseHasTheConfiguredSpread) {
  ReceiverConfig config = ideal();
  config.noise_m = 0.03;
  const World world = plain(kMatt);
  const CastScan exact = scan_of(world, ideal());
  const CastScan noisy = scan_of(world, config);
  double sum = 0;
  int count = 0;
  for (std::size_t i = 0; i < exact.range_m.size(); ++i) {
    if (exact.range_m[i] <= 0 || noisy.range_m[i] <= 0) continue;
    const double error = noisy.range_m[i] - exact.range_m[i];
    sum += error * error;
    ++count;
  }
  ASSERT_GT(count, 10000);
  EXPECT_NEAR(std::sqrt(sum / count), 0.03, 0.001);
}

TEST(Scanner, GrassAnswersBeforeTheGround) {
  Material grass = kMatt;
  grass.depth = 0.06F;
  const CastScan scan = scan_of(plain(grass), ideal());
  double height = 0;
  int count = 0;
  for (std::size_t i = 0; i < scan.points.size(); ++i) {
    if (scan.range_m[i] <= 0 || scan.range_m[i] > 8) continue;
    EXPECT_GE(scan.points[i].z(), -kHeight - 1e-3);
    height += scan.points[i].z() + kHeight;
    ++count;
  }
  EXPECT_NEAR(height / count, 0.06 * std::sqrt(2 / M_PI), 0.01);  // mean of |N(0, sd)|
}

TEST(Scanner, GlassLetsThroughWhatItDoesNotMirror) {
  World world = plain(kMatt);
  const MaterialId glass = world.add({kBuilding, 0.05F, 0, 0.99F, 0.5F, 0});
  for (const double y : {-3.0, 3.0})
    Pen(world.mesh).box({-30, y - 0.01, 0}, {30, y + 0.01, 5}, glass);
  const CastScan with = scan_of(world, ideal());
  const CastScan without = scan_of(plain(kMatt), ideal());
  int beyond = 0, all = 0;
  for (std::size_t i = 0; i < with.points.size(); ++i) {
    const Eigen::Vector3f& p = without.points[i];
    if (without.range_m[i] <= 0 || std::abs(p.y()) < 3.5F || std::abs(p.x()) > 2 * std::abs(p.y()))
      continue;
    ++all;
    beyond += with.range_m[i] > 0 && with.labels[i] == kRoad;
  }
  ASSERT_GT(all, 2000);
  EXPECT_NEAR(static_cast<double>(beyond) / all, 0.25, 0.05);  // two faces of a pane
}

TEST(Scanner, AMovingSensorDistortsTheScanByItsMotion) {
  World world;
  const MaterialId wall = world.add(kMatt);
  Pen(world.mesh).quad({50, -500, -50}, {50, 500, -50}, {50, 500, 50}, {50, -500, 50}, wall);
  const RayCaster caster(world);
  const Scanner scanner(caster, world, os1(), ideal(), 1);
  const CastScan scan =
      scanner.cast([](int column) { return placed(2.0 * column / 512, 0, 0); }, 0);
  for (int column = 0; column < scan.columns; ++column) {
    const std::size_t i = static_cast<std::size_t>(32) * scan.columns + column;
    if (scan.range_m[i] <= 0) continue;
    EXPECT_NEAR(scan.points[i].x(), 50 - 2.0 * column / 512, 2e-3);
  }
}

TEST(Scanner, TheSameSeedGivesTheSameScanAndAnotherAnotherOne) {
  const World world = plain(kMatt);
  const ReceiverConfig config;
  EXPECT_EQ(scan_of(world, config, 5).range_m, scan_of(world, config, 5).range_m);
  EXPECT_NE(scan_of(world, config, 5).range_m, scan_of(world, config, 6).range_m);
}

}  // namespace
}  // namespace saker::simulation
