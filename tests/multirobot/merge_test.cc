#include "saker/multirobot/merge.h"

#include <gtest/gtest.h>

#include "made_flights.h"

namespace saker::multirobot {
namespace {

using namespace slam;
using namespace slam::made;

const core::Budget kPlenty = core::Budget::iterations(10);

/// Known to 0.3 m and 1° where it took off, with an error of that size.
PosePrior take_off(const SE3& T_world_odom, core::Rng& rng) {
  Vector6d sd;
  sd << 0.005, 0.005, 0.017, 0.3, 0.3, 0.1;
  Vector6d error;
  for (int i = 0; i < 6; ++i) error[i] = rng.normal(0, sd[i]);
  return {T_world_odom * core::se3_exp(error), sd.cwiseAbs2().asDiagonal()};
}

PosePrior exact(const SE3& T) { return {T, 1e-8 * Matrix6d::Identity()}; }

/// Distance of each of the world's objects from the nearest of the map of its shape; 5 for none.
std::vector<double> place_errors(const objects::ObjectMap& map,
                                 const std::vector<TrueObject>& world) {
  std::vector<double> errors;
  for (const TrueObject& object : world) {
    double least = 5;
    for (const auto& mapped : map.objects) {
      if (is_cuboid(mapped.model) != is_cuboid(object.model)) continue;
      least = std::min(least, (objects::place(mapped.model) - objects::place(object.model)).norm());
    }
    errors.push_back(least);
  }
  return errors;
}

double mean(const std::vector<double>& values) {
  double sum = 0;
  for (const double value : values) sum += value;
  return sum / static_cast<double>(values.size());
}

TEST(Merge, TwoRobotsKnowMoreThanOne) {
  const auto world = ring_of_objects(20, 10);
  core::Rng rng(3);
  const Flown first = fly(world, loop(20, 0.6, 1), {}, 11),
              second = fly(world, back(loop(20, 0.6, 1)), {}, 12);
  MultiRobotSlam merged({}, honest_config(), {});
  (void)merged.add(first.history, exact(first.T_town_odom), kPlenty);
  const double alone = mean(place_errors(merged.map(), world));
  const MergeReport report = merged.add(second.history, take_off(second.T_town_odom, rng), kPlenty);
  EXPECT_EQ(report.status, MergeStatus::merged);
  EXPECT_EQ(report.created, 0);
  EXPECT_EQ(merged.map().objects.size(), 20U);
  EXPECT_LT(mean(place_errors(merged.map(), world)), alone);
}

TEST(Merge, WhatIsReportedIsWidenedAndHasWhatMeasurementsHaveInCommon) {
  SlamConfig config = honest_config();
  config.noise.shared_end_per_m = 0;
  const Flown flown = fly(ring_of_objects(20, 10), loop(20, 0.6, 1), {.drawn = 0}, 11);
  MultiRobotSlam merged({}, config, {});
  (void)merged.add(flown.history, exact(flown.T_town_odom), kPlenty);
  const objects::ObjectMap own = merged.map_with_covariance().map;
  const objects::ObjectMap reported = merged.reported_map();
  ASSERT_EQ(reported.objects.size(), 20U);
  for (std::size_t i = 0; i < own.objects.size(); ++i) {
    const bool cuboid = is_cuboid(own.objects[i].model);
    const int size = cuboid ? 6 : 5;  // length, or radius
    const double shared = cuboid ? config.noise.shared_length : config.noise.shared_radius;
    const double common = common_variances(own.objects[i].model, config.noise)[size];
    EXPECT_GT(common, 0);
    const double ratio = (reported.objects[i].covariance(size, size) - common) /
                         own.objects[i].covariance(size, size);
    EXPECT_NEAR(ratio, shared, 0.2 * shared);  // sizes hardly depend on the poses
  }
}

TEST(Merge, TheTakeOffIsAPriorAndNotAConstant) {
  const auto world = ring_of_objects(20, 10);
  const Flown first = fly(world, loop(20, 0.6, 1), {}, 21),
              second = fly(world, loop(20, 0.6, 1), {}, 22);
  PosePrior wrong = exact(second.T_town_odom);
  wrong.pose.translation().x() += 0.6;
  wrong.covariance = 0.09 * Matrix6d::Identity();
  MultiRobotSlam merged({}, honest_config(), {});
  (void)merged.add(first.history, exact(first.T_town_odom), kPlenty);
  (void)merged.add(second.history, wrong, kPlenty);
  const SE3 start = merged.flights()[1].keyframes[0].T_world_lidar;
  EXPECT_LT((start.translation() - second.T_town_odom.translation()).norm(), 0.2);
}

TEST(Merge, AHistoryThatGrowsIsAddedWhereItEnded) {
  const auto world = ring_of_objects(20, 10);
  const Flown flown = fly(world, loop(20, 0.6, 1), {}, 31);
  History half = flown.history;
  half.entries.resize(half.entries.size() / 2);
  MultiRobotSlam merged({}, honest_config(), {});
  EXPECT_EQ(merged.add(half, std::nullopt, kPlenty).entries, static_cast<int>(half.entries.size()));
  EXPECT_EQ(merged.add(half, std::nullopt, kPlenty).status, MergeStatus::nothing_new);
  const MergeReport rest = merged.add(flown.history, std::nullopt, kPlenty);
  EXPECT_EQ(rest.entries, static_cast<int>(flown.history.entries.size() - half.entries.size()));
  EXPECT_EQ(merged.flights().size(), 1U);
  EXPECT_EQ(merged.map().objects.size(), 20U);
}

TEST(Merge, WhatADeadlineLeavesIsAddedByTheNextCall) {
  const auto world = ring_of_objects(20, 10);
  const Flown flown = fly(world, loop(20, 0.6, 1), {}, 31);
  MultiRobotSlam merged({}, honest_config(), {});
  const core::Budget passed = core::Budget::until(core::Budget::Clock::now(), 10);
  EXPECT_EQ(merged.add(flown.history, std::nullopt, passed).entries, 1);
  const auto rest = static_cast<int>(flown.history.entries.size()) - 1;
  EXPECT_EQ(merged.add(flown.history, std::nullopt, kPlenty).entries, rest);
  EXPECT_EQ(merged.map().objects.size(), 20U);
}

TEST(Merge, RefusesAHistoryThatIsBrokenAndStaysAsItWas) {
  const auto world = ring_of_objects(20, 10);
  const Flown flown = fly(world, loop(20, 0.6, 0.3), {}, 41);
  MultiRobotSlam merged({}, honest_config(), {});
  History broken = flown.history;
  broken.entries[3].T_odom_lidar.translation().x() = NAN;
  EXPECT_EQ(merged.add(broken, std::nullopt, kPlenty).status, MergeStatus::invalid);
  broken = flown.history;
  std::swap(broken.entries[3].stamp, broken.entries[4].stamp);
  EXPECT_EQ(merged.add(broken, std::nullopt, kPlenty).status, MergeStatus::invalid);
  EXPECT_TRUE(merged.flights().empty());
  EXPECT_TRUE(merged.map().objects.empty());
}

TEST(Merge, WhatARobotTakesBackLeavesTheMap) {
  const auto world = ring_of_objects(20, 10);
  Flown flown = fly(world, loop(20, 0.6, 1), {}, 51);
  MultiRobotSlam before({}, honest_config(), {}), after({}, honest_config(), {});
  (void)before.add(flown.history, std::nullopt, kPlenty);
  for (HistoryEntry& entry : flown.history.entries) {
    if (entry.measurements.empty()) continue;
    Measurement moving = entry.measurements[0];
    moving.moving = true;
    flown.history.entries.push_back({flown.history.entries.back().stamp + 1,
                                     entry.T_odom_lidar,
                                     1e-4 * Matrix6d::Identity(),
                                     {moving}});
    break;
  }
  (void)after.add(flown.history, std::nullopt, kPlenty);
  EXPECT_EQ(after.map().objects.size() + 1, before.map().objects.size());
}

/// A fifth of the second robot's measurements are of something else, within the gates: each object
/// in the fifth is seen beside itself throughout.
TEST(Merge, AFifthOfWrongMatchesDoesNotBreakTheMap) {
  const auto world = ring_of_objects(20, 10);
  auto moved_world = world;
  core::Rng rng(6);
  for (std::size_t i = 0; i < world.size(); i += 5) {
    SE3 beside = flat_pose(0, 0, 0, 0);
    const double a = rng.uniform(0, 6.28), by = is_cuboid(world[i].model) ? 1.2 : 0.7;
    beside.translation() << by * std::cos(a), by * std::sin(a), 0;
    moved_world[i].model = objects::transformed(beside, world[i].model);
  }
  const Flown first = fly(world, loop(20, 0.6, 2), {}, 61),
              second = fly(world, loop(20, 0.6, 2), {}, 62);
  const Flown misled = fly(moved_world, loop(20, 0.6, 2), {}, 62);
  const auto merge = [&](const Flown& other) {
    MultiRobotSlam merged({}, honest_config(), {});
    (void)merged.add(first.history, exact(first.T_town_odom), kPlenty);
    (void)merged.add(other.history, exact(other.T_town_odom), kPlenty);
    return std::pair(path_error(merged.flights()[1], other), merged.map());
  };
  const auto [right_path, right_map] = merge(second);
  const auto [misled_path, misled_map] = merge(misled);
  EXPECT_LT(misled_path, 2 * right_path);
  std::vector<double> of_true_ones;
  const std::vector<double> all = place_errors(misled_map, world);
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (i % 5 != 0) of_true_ones.push_back(all[i]);
  }
  EXPECT_LT(mean(of_true_ones), 1.5 * mean(place_errors(right_map, world)));
}

/// The second robot sees of each vehicle little more than one half.
TEST(Merge, AVehicleThatAFlightMismeasuredIsNotTwo) {
  const auto world = ring_of_objects(20, 10);
  auto halves = world;
  for (TrueObject& object : halves) {
    if (auto* cuboid = std::get_if<Cuboid>(&object.model)) {
      cuboid->pose.translation() -= 0.85 * cuboid->pose.linear().col(0);
      cuboid->size.x() -= 1.7;
    }
  }
  const Flown first = fly(world, loop(20, 0.6, 1), {}, 81),
              second = fly(halves, loop(20, 0.6, 1), {}, 82);
  MultiRobotSlam merged({}, honest_config(), {});
  (void)merged.add(first.history, exact(first.T_town_odom), kPlenty);
  (void)merged.add(second.history, exact(second.T_town_odom), kPlenty);
  EXPECT_EQ(merged.map().objects.size(), 20U);
}

/// Measurements at random belong to other objects, anywhere on the ring, in the graph itself.
TEST(Merge, NarrowingKernelsShrugOffAFifthOfWrongObservations) {
  const auto world = ring_of_objects(20, 10);
  Flown flown = fly(world, loop(20, 0.6, 2), {}, 71);
  const Flown right = flown;
  core::Rng rng(7);
  for (HistoryEntry& entry : flown.history.entries) {
    for (Measurement& m : entry.measurements) {
      SE3 off = SE3::Identity();
      const double gate = is_cuboid(m.model) ? 1.4 : 0.7;
      off.translation() << rng.uniform(-gate, gate), rng.uniform(-gate, gate), 0;
      if (rng.chance(0.2)) m.model = objects::transformed(off, m.model);
    }
  }
  const auto error = [&](const Flown& f) {
    MultiRobotSlam merged({}, honest_config(), {});
    (void)merged.add(f.history, exact(f.T_town_odom), kPlenty);
    return path_error(merged.flights()[0], f);
  };
  EXPECT_LT(error(flown), 1.5 * error(right) + 0.02);
}

}  // namespace
}  // namespace saker::multirobot
