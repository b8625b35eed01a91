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

TEST_F(ScanEffectsTest, ABlockedSectorIsEmptyFromItsRowDownwards) {
  ScanEffects effects;
  effects.blocked.push_back({1.0, 0.3, 0.5});
  const SensorUnit made = unit(SensorChoice::pandar64);
  const CastScan plain = cast(made), scan = with(effects, made);
  int lost = 0;
  for (int row = 0; row < scan.rows; ++row) {
    for (int column = 0; column < scan.columns; ++column) {
      const std::size_t i = made.beams.index(row, column);
      const Eigen::Vector3f& beam = made.beams.directions[i];
      const double off = std::remainder(std::atan2(beam.y(), beam.x()) - 1.0, 2 * M_PI);
      const bool blocked = std::abs(off) < 0.3 && row >= scan.rows / 2;
      EXPECT_EQ(scan.range_m[i], blocked ? 0 : plain.range_m[i]);
      lost += blocked && plain.range_m[i] > 0;
    }
  }
  EXPECT_GT(lost, 500);
}

TEST_F(ScanEffectsTest, WhatIsFartherThanTheCutIsNotInTheFile) {
  ScanEffects effects;
  effects.range_cut_m = 15;
  const CastScan scan = with(effects, unit(SensorChoice::os0_64));
  int kept = 0;
  for (const float range : scan.range_m) {
    EXPECT_LE(range, 15);
    kept += range > 0;
  }
  EXPECT_GT(kept, 1000);
}

TEST_F(ScanEffectsTest, ALostPacketTakesItsColumnsOfAllRows) {
  ScanEffects effects;
  effects.lost_packets = 3;
  effects.packet_columns = 16;
  const SensorUnit made = unit(SensorChoice::vlp_16);
  const CastScan plain = cast(made), scan = with(effects, made);
  int columns = 0;
  for (int column = 0; column < scan.columns; ++column) {
    int before = 0, after = 0;
    for (int row = 0; row < scan.rows; ++row) {
      before += plain.range_m[made.beams.index(row, column)] > 0;
      after += scan.range_m[made.beams.index(row, column)] > 0;
    }
    EXPECT_TRUE(after == before || after == 0);
    columns += before > 0 && after == 0;
  }
  EXPECT_GE(columns, 16);
  EXPECT_LE(columns, 48);
}

TEST_F(ScanEffectsTest, CrosstalkIsTheShareThatWasAskedForAnywhereInTheRange) {
  ScanEffects effects;
  effects.crosstalk_share = 0.01;
  const SensorUnit made = unit(SensorChoice::hdl_32e);
  const CastScan scan = with(effects, made);
  EXPECT_NEAR(outliers(scan) / (0.01 * static_cast<double>(scan.range_m.size())), 1, 0.03);
  float nearest = 1e9F, farthest = 0;
  for (std::size_t i = 0; i < scan.range_m.size(); ++i) {
    if (scan.range_m[i] <= 0 || scan.labels[i] != kOutlier) continue;
    nearest = std::min(nearest, scan.range_m[i]);
    farthest = std::max(farthest, scan.range_m[i]);
  }
  EXPECT_GE(nearest, made.receiver.min_range_m);
  EXPECT_GT(farthest, 0.9 * made.receiver.max_range_m);
}

/// Light goes there and back: at 10 m and 0.05 / m the share that comes back is exp(−1).
TEST_F(ScanEffectsTest, FogTakesReturnsByTheirRange) {
  ScanEffects effects;
  effects.extinction_per_m = 0.05;
  const SensorUnit made = unit(SensorChoice::vls_128);
  const CastScan plain = cast(made), scan = with(effects, made);
  int all = 0, kept = 0;
  for (std::size_t i = 0; i < plain.range_m.size(); ++i) {
    if (std::abs(plain.range_m[i] - 10) > 0.5F) continue;
    ++all;
    kept += scan.range_m[i] > 0;
  }
  ASSERT_GT(all, 2000);
  EXPECT_NEAR(static_cast<double>(kept) / all, std::exp(-1), 0.04);
}

TEST_F(ScanEffectsTest, AThinPuffAnswersLessOftenThanADenseOne) {
  const auto answers = [&](float density) {
    ScanEffects effects;
    effects.puffs.push_back({{6, 0, 1}, 1, density});
    return outliers(with(effects, unit(SensorChoice::os1_64)));
  };
  EXPECT_GT(answers(1.0F), 3 * answers(0.05F));
}

TEST_F(ScanEffectsTest, DryGroundIsLeftAsItIs) {
  World wet = world_;
  wet_ground(wet, 0);
  EXPECT_EQ(wet.materials[0].reflectivity, world_.materials[0].reflectivity);
  EXPECT_EQ(wet.materials[0].gloss, world_.materials[0].gloss);
}

TEST_F(ScanEffectsTest, WetGroundIsDarkerAndGlossierAndWallsAreNot) {
  World wet = world_;
  wet_ground(wet, 0.5);
  EXPECT_FLOAT_EQ(wet.materials[0].reflectivity, 0.3F * 0.7F);
  EXPECT_FLOAT_EQ(wet.materials[0].gloss, 0.725F);
  EXPECT_EQ(wet.materials[1].reflectivity, world_.materials[1].reflectivity);
  EXPECT_EQ(wet.materials[1].gloss, 0);
}

TEST_F(ScanEffectsTest, MostDaysAreClear) {
  core::Rng rng(3);
  int rain = 0, fog = 0, spray = 0;
  for (int i = 0; i < 3000; ++i) {
    const ScanEffects effects = any_weather(mount_, rng);
    fog += effects.near_share >= 0.005 && effects.extinction_per_m > 0.0036;
    rain += effects.near_share > 0;
    spray += !effects.puffs.empty();
  }
  EXPECT_NEAR(rain / 3000.0, 0.11, 0.02);
  EXPECT_NEAR(spray / 3000.0, 0.1, 0.02);
  EXPECT_NEAR(fog / 3000.0, 0.03, 0.015);
}

TEST_F(ScanEffectsTest, PuffsHangOverTheGroundAboutTheVehicle) {
  mount_.T_world_vehicle = placed(100, 50, 3, 1);
  core::Rng rng(3);
  for (int i = 0; i < 400; ++i) {
    for (const Puff& puff : any_weather(mount_, rng).puffs) {
      const Eigen::Vector3d at = mount_.T_world_vehicle.inverse() * puff.centre.cast<double>();
      EXPECT_GT(at.z(), 0.1);
      EXPECT_LT(at.z(), 3);
      EXPECT_LT(at.head<2>().norm(), 33);
    }
  }
}

TEST_F(ScanEffectsTest, TheUnitsOwnEffectsStayWithinTheirRanges) {
  const SensorUnit made = unit(SensorChoice::pandar64);
  core::Rng rng(6);
  int native_steps = 0, echoes = 0, sectors = 0;
  for (int i = 0; i < 2000; ++i) {
    ScanEffects effects;
    add_sensor_effects(made, effects, rng);
    native_steps += effects.range_step_m == made.range_step_m;
    echoes += effects.echo_share > 0;
    sectors += !effects.blocked.empty();
    EXPECT_LE(effects.crosstalk_share, 1e-5 * std::exp(4.0));
    EXPECT_LE(effects.lost_packets, 12);
    EXPECT_GE(effects.packet_columns, 2);
    EXPECT_LE(effects.packet_columns, 31);
    EXPECT_LE(effects.blocked.size(), 4U);
  }
  EXPECT_NEAR(native_steps / 2000.0, 0.7, 0.03);
  EXPECT_NEAR(echoes / 2000.0, 0.15, 0.03);
  EXPECT_NEAR(sectors / 2000.0, 0.3, 0.04);
}

}  // namespace
}  // namespace saker::simulation
