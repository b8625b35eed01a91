#include "saker/simulation/sensor/scan_effects.h"

#include <gtest/gtest.h>

#include "saker/simulation/sensor/scan_points.h"

namespace saker::simulation {
namespace {

/// A street of one wall beside a plain, and a sensor 2 m over it.
class ScanEffectsTest : public testing::Test {
 protected:
  ScanEffectsTest() {
    const MaterialId ground = world_.add({kRoad, 0.3F, 0, 0, 0, 0});
    const MaterialId wall = world_.add({kBuilding, 0.4F, 0, 0, 0, 0});
    Pen(world_.mesh).quad({-200, -200, 0}, {200, -200, 0}, {200, 200, 0}, {-200, 200, 0}, ground);
    Pen(world_.mesh).box({-30, 10, 0}, {30, 11, 6}, wall);
    mount_.height_m = 2;
    mount_.T_vehicle_lidar = placed(0, 0, 2);
  }

  SensorUnit unit(SensorChoice choice) const {
    core::Rng rng(7);
    SensorUnit made = make_unit(choice, rng);
    made.receiver.noise_m = made.receiver.noise_per_m = made.receiver.beam_bias_m = 0;
    made.receiver.divergence_mrad = made.receiver.mixed_share = made.receiver.drop_share = 0;
    return made;
  }

  CastScan cast(const SensorUnit& made) const {
    const RayCaster caster(world_);
    const Scanner scanner(caster, world_, made.beams, made.receiver, 3);
    return scanner.cast([&](int) { return mount_.pose(0); }, 0);
  }

  CastScan with(const ScanEffects& effects, const SensorUnit& made) const {
    const RayCaster caster(world_);
    CastScan scan = cast(made);
    core::Rng rng(5);
    const ScanSetting setting{&caster, &world_, &made, &mount_,
                              [&](int) { return mount_.pose(0); }};
    apply_effects(effects, setting, rng, scan);
    return scan;
  }

  static int outliers(const CastScan& scan) {
    int count = 0;
    for (std::size_t i = 0; i < scan.range_m.size(); ++i)
      count += scan.range_m[i] > 0 && scan.labels[i] == kOutlier;
    return count;
  }

  World world_;
  Mount mount_;
};

TEST_F(ScanEffectsTest, WithoutAnyTheScanIsAsItWasCast) {
  const SensorUnit made = unit(SensorChoice::pandar64);
  const CastScan plain = cast(made);
  const CastScan same = with({}, made);
  EXPECT_EQ(plain.range_m, same.range_m);
  EXPECT_EQ(plain.labels, same.labels);
  EXPECT_EQ(plain.reflectivity, same.reflectivity);
}

TEST_F(ScanEffectsTest, TwoSensorsSeeTheSameSurfaces) {
  for (const SensorChoice choice : {SensorChoice::vlp_16, SensorChoice::vls_128,
                                    SensorChoice::vlp_32c_pair, SensorChoice::os0_64}) {
    const SensorUnit made = unit(choice);
    const CastScan scan = cast(made);
    int wall = 0;
    for (std::size_t i = 0; i < scan.range_m.size(); ++i) {
      if (scan.range_m[i] <= 0) continue;
      if (scan.labels[i] == kRoad) {
        EXPECT_NEAR(scan.points[i].z(), -2, 0.002) << made.name;
      } else if (scan.points[i].z() < 3.9F && std::abs(scan.points[i].x()) < 29) {
        EXPECT_NEAR(scan.points[i].y(), 10, 0.002) << made.name;
        ++wall;
      }
    }
    EXPECT_GT(wall, 500) << made.name;
  }
}

TEST_F(ScanEffectsTest, RainAnswersNearTheSensorAndCountsAsNothing) {
  ScanEffects effects;
  effects.near_share = 0.02;
  const CastScan scan = with(effects, unit(SensorChoice::hdl_32e));
  EXPECT_GT(outliers(scan), 300);
  for (std::size_t i = 0; i < scan.range_m.size(); ++i) {
    if (scan.range_m[i] <= 0 || scan.labels[i] != kOutlier) continue;
    EXPECT_LT(scan.range_m[i], 50);
  }
}

TEST_F(ScanEffectsTest, APuffAnswersFromWithinItself) {
  ScanEffects effects;
  effects.puffs.push_back({{6, 0, 1}, 1, 1.0F});
  const CastScan scan = with(effects, unit(SensorChoice::os1_64));
  EXPECT_GT(outliers(scan), 50);
  for (std::size_t i = 0; i < scan.range_m.size(); ++i) {
    if (scan.range_m[i] <= 0 || scan.labels[i] != kOutlier) continue;
    EXPECT_LT((scan.points[i] - Eigen::Vector3f(6, 0, -1)).norm(), 1.05F);
  }
}

TEST_F(ScanEffectsTest, TheCarriersBodyHidesWhatIsBehindIt) {
  mount_.body = {{{-3, -3, 0.3}, {3, 3, 1.2}}};
  const SensorUnit made = unit(SensorChoice::hdl_64e);
  const CastScan hidden = with({}, made);
  ScanEffects effects;
  effects.own_return_share = 1;
  const CastScan shown = with(effects, made);
  const CastScan plain = cast(made);
  int own = 0;
  for (std::size_t i = 0; i < plain.range_m.size(); ++i) {
    if (plain.range_m[i] <= 0 || hidden.range_m[i] > 0) continue;
    if (shown.range_m[i] <= 0) continue;
    ++own;
    EXPECT_EQ(shown.labels[i], kUnlabelled);
    EXPECT_LT(shown.range_m[i], plain.range_m[i]);
  }
  EXPECT_GT(own, 500);
}

TEST_F(ScanEffectsTest, WetGroundMirrorsTheWallBelowItself) {
  wet_ground(world_, 1);
  ScanEffects effects;
  effects.ghost_share = 1;
  const CastScan scan = with(effects, unit(SensorChoice::vls_128));
  int below = 0;
  for (std::size_t i = 0; i < scan.range_m.size(); ++i) {
    if (scan.range_m[i] <= 0 || scan.labels[i] != kOutlier) continue;
    EXPECT_LT(scan.points[i].z(), -1.99F);
    below += std::abs(scan.points[i].y() - 10) < 0.02F;
  }
  EXPECT_GT(below, 100);
}

TEST_F(ScanEffectsTest, RangesAreMultiplesOfTheStep) {
  ScanEffects effects;
  effects.range_step_m = 0.02;
  const CastScan scan = with(effects, unit(SensorChoice::xt32));
  for (const float range : scan.range_m) EXPECT_NEAR(std::remainder(range, 0.02), 0, 1e-4);
}

TEST_F(ScanEffectsTest, SecondReturnsComeFromBehindEdges) {
  const SensorUnit made = unit(SensorChoice::pandar64);
  const CastScan scan = cast(made);
  core::Rng rng(1);
  const std::vector<ScanPoint> single = points_of(scan, made, 0, rng);
  const std::vector<ScanPoint> both = points_of(scan, made, 1, rng);
  EXPECT_GT(both.size(), single.size());
  for (std::size_t k = 1; k < both.size(); ++k) {
    const bool same_beam = both[k].ring == both[k - 1].ring && both[k].column == both[k - 1].column;
    if (!same_beam) continue;
    EXPECT_GT(both[k].position.norm(), both[k - 1].position.norm() + 0.9F);
  }
}

}  // namespace
}  // namespace saker::simulation
