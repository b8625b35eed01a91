/// What merging makes of drift.
#include <gtest/gtest.h>

#include <cstdio>

#include "made_flights.h"

namespace saker::multirobot {
namespace {

using namespace slam;
using namespace slam::made;

const core::Budget kPlenty = core::Budget::iterations(10);

/// Vehicles, trunks and poles at irregular places on both sides of a ring, of all sizes.
std::vector<TrueObject> irregular_ring(double radius, int count, std::uint64_t seed) {
  core::Rng rng(seed);
  std::vector<TrueObject> all;
  for (int i = 0; i < count; ++i) {
    const double a = 2 * std::numbers::pi * (i + rng.uniform(-0.1, 0.1)) / count;
    const double out = radius + 6 + rng.normal(0, 1), in = radius - 5 + rng.normal(0, 1);
    const Cuboid vehicle =
        car(out * std::cos(a), out * std::sin(a), a + std::numbers::pi / 2 + rng.normal(0, 0.1),
            rng.uniform(3.7, 5.2), rng.uniform(1.65, 1.95));
    all.push_back({vehicle, kVehicle});
    const double b = a + rng.uniform(-0.3, 0.3) / count;
    Cylinder stem = trunk(in * std::cos(b), in * std::sin(b));
    stem.radius = rng.uniform(0.1, 0.3);
    all.push_back({stem, kTrunk});
  }
  return all;
}

/// A step of 0.6 m drifts as LiDAR odometry does without loops: a per cent of the way.
Noise drifting(double rotation) {
  Noise noise;
  noise.rotation = rotation;
  noise.translation = 0.01;
  return noise;
}

std::vector<SE3> from(std::vector<SE3> poses, double share) {
  std::ranges::rotate(poses, poses.begin() + static_cast<std::ptrdiff_t>(
                                                 share * static_cast<double>(poses.size())));
  return poses;
}

double odometry_end_error(const Flown& flown) {
  const SE3 end = flown.T_town_odom * flown.history.entries.back().T_odom_lidar;
  return (end.translation() - flown.truth.back().translation()).norm();
}

PosePrior roughly(const SE3& T, core::Rng& rng) {
  Vector6d sd;
  sd << 0.005, 0.005, 0.017, 0.3, 0.3, 0.1;
  Vector6d error;
  for (int i = 0; i < 6; ++i) error[i] = rng.normal(0, sd[i]);
  return {T * core::se3_exp(error), sd.cwiseAbs2().asDiagonal()};
}

TEST(Drift, ThreeFlightsOf300MetresEndAtMostHalfAsFarOffAsOdometry) {
  constexpr double kRadius = 47.8;
  double odometry = 0, merged_ends = 0;
  for (std::uint64_t seed = 1; seed <= 2; ++seed) {
    core::Rng rng(seed);
    const auto world = irregular_ring(kRadius, 45, seed);
    const std::vector<SE3> round = loop(kRadius, 0.6);
    const std::vector<std::vector<SE3>> routes = {round, from(round, 0.3), back(from(round, 0.6))};
    MultiRobotSlam merged({}, honest_config(), {});
    for (std::size_t i = 0; i < routes.size(); ++i) {
      const Flown flown = fly(world, routes[i], drifting(0.0008), 10 * seed + i, 15, 0);
      const PosePrior start = i == 0 ? PosePrior{flown.T_town_odom, 1e-8 * Matrix6d::Identity()}
                                     : roughly(flown.T_town_odom, rng);
      ASSERT_EQ(merged.add(flown.history, start, kPlenty).status, MergeStatus::merged);
      odometry += odometry_end_error(flown);
      merged_ends += end_error(merged.flights()[i], flown);
    }
  }
  std::printf("mean end error: odometry %.2f m, merged %.2f m\n", odometry / 6, merged_ends / 6);
  EXPECT_GT(odometry / 6, 0.5);
  EXPECT_LT(merged_ends, 0.5 * odometry);
}

/// Two robots that never heard of each other's take-off.
TEST(Drift, FlightsWithUnknownTakeOffsBecomeOneMap) {
  constexpr double kRadius = 30;
  const auto world = irregular_ring(kRadius, 28, 9);
  const std::vector<SE3> round = loop(kRadius, 0.6);
  const Flown first = fly(world, round, drifting(0.0005), 91, 15, 0);
  const Flown second = fly(world, back(from(round, 0.4)), drifting(0.0005), 92, 15, 0);
  MultiRobotSlam merged({}, honest_config(), {});
  (void)merged.add(first.history, PosePrior{first.T_town_odom, 1e-8 * Matrix6d::Identity()},
                   kPlenty);
  const MergeReport report = merged.add(second.history, std::nullopt, kPlenty);
  ASSERT_EQ(report.status, MergeStatus::merged);
  EXPECT_LT(report.alignment.probability_wrong, 1e-4);
  EXPECT_LT(path_error(merged.flights()[1], second), 0.3);
  const Flown elsewhere = fly(irregular_ring(kRadius, 28, 10), round, drifting(0.0005), 93, 15, 0);
  EXPECT_EQ(merged.add(elsewhere.history, std::nullopt, kPlenty).status, MergeStatus::not_aligned);
  EXPECT_EQ(merged.flights().size(), 2U);
}

/// One robot flies on over where it began. Where drift has carried its own objects out of the gates
/// of association, constellations find them again.
TEST(Drift, ALoopOf300MetresThatDriftOpenedByMetresIsClosedInOneFlightsOwnMap) {
  constexpr double kRadius = 47.8, kRounds = 1.35;
  double opened = 0, closed = 0;
  int loops = 0;
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    const auto world = irregular_ring(kRadius, 45, seed);
    const Flown flown = fly(world, loop(kRadius, 0.6, kRounds), drifting(0.0025), seed, 15, 0);
    MultiRobotSlam graph({}, honest_config(), {});
    const MergeReport report = graph.add(
        flown.history, PosePrior{flown.T_town_odom, 1e-8 * Matrix6d::Identity()}, kPlenty);
    const double end = end_error(graph.flights()[0], flown);
    std::printf("seed %d: odometry ends %.2f m off, the graph %.2f m; %d constellations\n",
                static_cast<int>(seed), odometry_end_error(flown), end, report.loops);
    EXPECT_LT(end, 1);
    EXPECT_LE(graph.map().objects.size(), world.size());  // nothing twice
    opened += odometry_end_error(flown);
    closed += end;
    loops += report.loops;
  }
  EXPECT_GT(opened / 5, 3);
  EXPECT_LT(closed, 0.2 * opened);
  EXPECT_GE(loops, 1);
}

}  // namespace
}  // namespace saker::multirobot
