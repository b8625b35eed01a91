#include "saker/simulation/sensor/scanner.h"

#include <gtest/gtest.h>

#include "drawn.h"
#include "saker/core/error.h"

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

/// Returns of a scan of a wall that stands all around the sensor at `distance`.
struct Ring {
  int returns = 0;
  Spread range;
};

Ring ring_at(double distance, const Material& material, const ReceiverConfig& config,
             std::uint64_t seed = 1) {
  World world;
  const MaterialId id = world.add(material);
  constexpr int kSides = 720;
  Pen pen(world.mesh);
  const auto corner = [&](int i, double z) {
    const double angle = 2 * M_PI * i / kSides;
    return Eigen::Vector3d(distance * std::cos(angle), distance * std::sin(angle), z);
  };
  for (int i = 0; i < kSides; ++i)
    pen.quad(corner(i, -50), corner(i + 1, -50), corner(i + 1, 50), corner(i, 50), id);
  const RayCaster caster(world);
  BeamTable level;
  level.rows = 1;
  level.columns = 4096;
  for (int i = 0; i < level.columns; ++i) {
    const double angle = -2 * M_PI * i / level.columns;
    level.origins.emplace_back(0, 0, 0);
    level.directions.push_back(Eigen::Vector3d(std::cos(angle), std::sin(angle), 0).cast<float>());
  }
  const Scanner scanner(caster, world, level, config, seed);
  const CastScan scan = scanner.cast([](int) { return SE3::Identity(); }, 0);
  Ring ring;
  for (const float range : scan.range_m) {
    if (range <= 0) continue;
    ++ring.returns;
    ring.range.add(range);
  }
  return ring;
}

TEST(Scanner, BeamsAreLostAtTheConfiguredShare) {
  ReceiverConfig config = ideal();
  config.drop_share = 0.2;
  EXPECT_NEAR(ring_at(10, kMatt, config).returns / 4096.0, 0.8, 0.02);
}

/// At reflectivity / range² = sensitivity 63 % of the beams answer.
TEST(Scanner, TheSensitivitySaysWhereTwoThirdsOfTheBeamsAnswer) {
  ReceiverConfig config = ideal();
  config.sensitivity = 0.3 / (40.0 * 40.0);
  EXPECT_NEAR(ring_at(40, kMatt, config).returns / 4096.0, 1 - std::exp(-1), 0.03);
  EXPECT_GT(ring_at(10, kMatt, config).returns, 4080);
  EXPECT_LT(ring_at(160, kMatt, config).returns, 600);
}

TEST(Scanner, DarkSurfacesAnswerLessOftenThanBrightOnes) {
  ReceiverConfig config = ideal();
  config.sensitivity = 0.3 / (40.0 * 40.0);
  Material dark = kMatt;
  dark.reflectivity = 0.03F;
  EXPECT_NEAR(ring_at(40, dark, config).returns / 4096.0, 1 - std::exp(-0.1), 0.03);
}

TEST(Scanner, NothingComesFromNearerOrFartherThanTheReceiverListens) {
  ReceiverConfig config = ideal();
  config.min_range_m = 5;
  config.max_range_m = 20;
  EXPECT_EQ(ring_at(4.9, kMatt, config).returns, 0);
  EXPECT_EQ(ring_at(5.1, kMatt, config).returns, 4096);
  EXPECT_EQ(ring_at(19.9, kMatt, config).returns, 4096);
  EXPECT_EQ(ring_at(20.2, kMatt, config).returns, 0);
}

TEST(Scanner, NoiseGrowsWithTheRange) {
  ReceiverConfig config = ideal();
  config.noise_m = 0.01;
  config.noise_per_m = 0.001;
  EXPECT_NEAR(ring_at(10, kMatt, config).range.sd(), 0.02, 0.002);
  EXPECT_NEAR(ring_at(40, kMatt, config).range.sd(), 0.05, 0.004);
}

TEST(Scanner, RangesHaveNoBiasButTheBeams) {
  ReceiverConfig config = ideal();
  config.noise_m = 0.02;
  EXPECT_NEAR(ring_at(10, kMatt, config).range.mean(), 10, 0.002);
}

TEST(Scanner, ABeamsBiasIsConstantAndSpreadsFromUnitToUnit) {
  ReceiverConfig config = ideal();
  config.beam_bias_m = 0.05;
  Spread bias;
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    const Ring ring = ring_at(10, kMatt, config, seed);
    EXPECT_LT(ring.range.sd(), 0.002);
    bias.add(ring.range.mean() - 10);
  }
  EXPECT_NEAR(bias.sd(), 0.05, 0.012);
  EXPECT_NEAR(bias.mean(), 0, 0.02);
}

TEST(Scanner, TheReflectivityThatIsReportedIsTheSurfaces) {
  for (const float reflectivity : {0.1F, 0.5F, 0.9F}) {
    Material material = kMatt;
    material.reflectivity = reflectivity;
    const CastScan scan = scan_of(plain(material), ideal());
    for (std::size_t i = 0; i < scan.range_m.size(); ++i) {
      if (scan.range_m[i] > 0) {
        ASSERT_NEAR(scan.reflectivity[i], reflectivity, 0.006);
      }
    }
  }
}

TEST(Scanner, BlocksInTheirOrderAreTheWholeScan) {
  const World world = plain(kMatt);
  const RayCaster caster(world);
  const Scanner scanner(caster, world, os1(), {}, 9);
  const auto pose = [](int column) { return placed(0.01 * column, 0, kHeight); };
  const CastScan whole = scanner.cast(pose, 4);
  CastScan pieces = scanner.empty_scan();
  core::Rng rng = scanner.rng_of(4);
  for (int first = 0; first < 512; first += Scanner::kColumnsAtOnce)
    scanner.cast_block(first, pose, rng, pieces);
  EXPECT_EQ(whole.range_m, pieces.range_m);
  EXPECT_EQ(whole.reflectivity, pieces.reflectivity);
}

TEST(Scanner, TheWorldIsBroughtToTheTimeOfEachBlock) {
  const World world = plain(kMatt);
  const RayCaster caster(world);
  const Scanner scanner(caster, world, os1(), {}, 9);
  std::vector<int> told;
  (void)scanner.cast([](int) { return placed(0, 0, kHeight); }, 0,
                     [&](int column) { told.push_back(column); });
  ASSERT_EQ(told.size(), 512U / Scanner::kColumnsAtOnce);
  for (std::size_t i = 0; i < told.size(); ++i)
    EXPECT_EQ(told[i], static_cast<int>(i) * Scanner::kColumnsAtOnce);
}

TEST(Scanner, APointIsItsBeamAtItsRange) {
  const World world = plain(kMatt);
  const CastScan scan = scan_of(world, {}, 4);
  const BeamTable beams = os1();
  for (std::size_t i = 0; i < scan.range_m.size(); ++i) {
    if (scan.range_m[i] <= 0) continue;
    const Eigen::Vector3f expected = beams.origins[i] + scan.range_m[i] * beams.directions[i];
    ASSERT_LT((scan.points[i] - expected).norm(), 1e-5F);
  }
}

/// Beams at the edge of a post before a wall answer from between, as many as configured.
TEST(Scanner, EdgesAnswerFromBetweenAtTheConfiguredShare) {
  World world;
  const MaterialId matt = world.add(kMatt);
  Pen(world.mesh).quad({10, -50, -50}, {10, 50, -50}, {10, 50, 50}, {10, -50, 50}, matt);
  for (double y = -9; y <= 9; y += 0.6)
    Pen(world.mesh).box({9.0, y - 0.1, -50}, {9.1, y + 0.1, 50}, matt);
  const RayCaster caster(world);
  const auto between = [&](double share) {
    ReceiverConfig config = ideal();
    config.mixed_share = share;
    const Scanner scanner(caster, world, os1(1024), config, 1);
    const CastScan scan = scanner.cast([](int) { return SE3::Identity(); }, 0);
    int count = 0;
    for (std::size_t i = 0; i < scan.points.size(); ++i) {
      const Eigen::Vector3f& p = scan.points[i];
      const bool ahead = scan.range_m[i] > 0 && std::abs(p.y()) < 3 && std::abs(p.z()) < 2;
      count += ahead && p.x() > 9.13F && p.x() < 9.97F;
    }
    return count;
  };
  const double half = between(0.5), all = between(1);
  EXPECT_EQ(between(0), 0);
  ASSERT_GT(all, 200);
  EXPECT_NEAR(half / all, 0.5, 0.1);
}

TEST(Scanner, AShareOutOfItsBoundsIsRefusedByName) {
  const World world = plain(kMatt);
  const RayCaster caster(world);
  ReceiverConfig config;
  config.drop_share = 1.5;
  try {
    const Scanner scanner(caster, world, os1(), config, 1);
    FAIL();
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("receiver.drop_share"), std::string::npos);
  }
}

}  // namespace
}  // namespace saker::simulation
