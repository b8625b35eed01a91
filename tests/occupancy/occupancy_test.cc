#include "saker/occupancy/occupancy.h"

#include <gtest/gtest.h>

#include "made_scan.h"
#include "saker/core/error.h"
#include "saker/occupancy/open_beam.h"
#include "stock.h"

namespace saker::occupancy {
namespace {

using Eigen::Vector3d;
using Eigen::Vector3f;
using made::pose;

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

/// Every node, inner ones included: where it is, how deep, its log-odds.
std::vector<std::tuple<std::uint64_t, unsigned, float>> nodes(const octomap::OcTree& tree) {
  std::vector<std::tuple<std::uint64_t, unsigned, float>> all;
  for (auto node = tree.begin_tree(); node != tree.end_tree(); ++node) {
    const octomap::OcTreeKey key = node.getKey();
    all.emplace_back((std::uint64_t{key[0]} << 32) | (std::uint64_t{key[1]} << 16) | key[2],
                     node.getDepth(), node->getLogOdds());
  }
  std::sort(all.begin(), all.end());
  return all;
}

void expect_same_tree(const octomap::OcTree& ours, const octomap::OcTree& stock) {
  EXPECT_EQ(ours.size(), stock.size());
  EXPECT_EQ(ours.calcNumNodes(), stock.size());
  EXPECT_TRUE(nodes(ours) == nodes(stock));
}

/// Both maps over the same scans.
struct Pair {
  explicit Pair(const OccupancyConfig& given = {})
      : config(given), ours(given), stock(given.resolution_m) {
    made::configure(stock, config);
  }
  void insert(const std::vector<Vector3f>& points, const SE3& T_odom_lidar) {
    ASSERT_EQ(ours.insert(points, T_odom_lidar, stamp += 100'000'000).status, InsertStatus::ok);
    made::insert(stock, config, points, T_odom_lidar);
  }
  OccupancyConfig config;
  OccupancyMap ours;
  octomap::OcTree stock;
  Time stamp = 0;
};

TEST(OccupancyMap, ABeamWithoutAReturnIsNoHitAndClearsFromItsRangeOn) {
  OccupancyMap map({});
  const Vector3f open(kOpenBeam_m + 5, 0, 0), whole(0, kOpenBeam_m, 0);
  ASSERT_EQ(map.insert(std::vector{open, whole}, SE3::Identity(), 1).status, InsertStatus::ok);
  const auto at = [&](double x, double y) { return map.tree().search(x, y, 0.0); };
  EXPECT_EQ(at(4.5, 0), nullptr);
  ASSERT_NE(at(6, 0), nullptr);
  EXPECT_LT(at(6, 0)->getOccupancy(), 0.5);
  ASSERT_NE(at(0, 1), nullptr);
  EXPECT_EQ(at(0, 16), nullptr);
}

TEST(OccupancyMap, MakesTheSameTreeAsOctoMapOverAFlight) {
  Pair maps;
  core::Rng rng(1);
  for (int i = 0; i < 4; ++i) {
    const SE3 T = pose({0.7 * i, 0.31 * i, 1.5 + 0.2 * i}, 0.4 * i, 0.05 * i);
    maps.insert(made::scan(made::yard(), T, {}, rng), T);
  }
  expect_same_tree(maps.ours.tree(), maps.stock);
}

TEST(OccupancyMap, MakesTheSameTreeAsOctoMapWhereCellsAreClampedAndPruned) {
  Pair maps;
  core::Rng rng(2);
  made::Beams beams;
  beams.columns = 256;
  const SE3 T = pose({0.1, 0.1, 2}, 0);
  for (int i = 0; i < 8; ++i) maps.insert(made::scan(made::yard(), T, beams, rng), T);
  made::BoxWorld emptied;  // vans and posts gone: occupied cells become free again
  for (int i = 0; i < 8; ++i) maps.insert(made::scan(emptied, T, beams, rng), T);
  expect_same_tree(maps.ours.tree(), maps.stock);
}

TEST(OccupancyMap, MakesTheSameTreeAsOctoMapOfPointsAtRandom) {
  OccupancyConfig config;
  config.body_radius_m = 0;
  config.resolution_m = 0.2;
  Pair maps(config);
  core::Rng rng(3);
  for (int i = 0; i < 6; ++i) {
    std::vector<Vector3f> points;
    for (int k = 0; k < 2000; ++k)  // from within the sensor's own cell to far beyond the range
      points.push_back(Vector3d(rng.normal(), rng.normal(), rng.normal()).cast<float>() *
                       static_cast<float>(std::exp(rng.uniform(-4, 4))));
    maps.insert(points, pose({rng.uniform(-50, 50), rng.uniform(-50, 50), rng.uniform(-5, 5)}, i));
  }
  expect_same_tree(maps.ours.tree(), maps.stock);
}

TEST(OccupancyMap, MakesTheSameTreeAsOctoMapOfRaysAlongAxesAndDiagonals) {
  Pair maps;
  std::vector<Vector3f> points;
  for (int x = -1; x <= 1; ++x)
    for (int y = -1; y <= 1; ++y)
      for (int z = -1; z <= 1; ++z)
        for (const float reach : {1.f, 2.5f, 14.99f, 15.f, 15.01f, 40.f})
          points.emplace_back(reach * Eigen::Vector3i(x, y, z).cast<float>());
  maps.insert(points, pose({0, 0, 0}, 0));              // in a corner of cells: every tie there is
  maps.insert(points, pose({0.125, 0.125, 0.125}, 0));  // in the middle of one
  maps.insert(points, pose({0.125, -0.25, 3.3}, 0.7853));
  expect_same_tree(maps.ours.tree(), maps.stock);
}

TEST(OccupancyMap, MakesTheSameTreeAsOctoMapWhereTheSensorsOwnCellIsOccupied) {
  OccupancyConfig config;
  config.body_radius_m = 0;
  Pair maps(config);
  maps.insert({{0.01f, 0.02f, 0.01f}, {3, 0, 0}, {0, -5, 1}}, pose({0.1, 0.1, 0.1}, 0));
  expect_same_tree(maps.ours.tree(), maps.stock);
  EXPECT_TRUE(maps.ours.tree().isNodeOccupied(maps.ours.tree().search(0.1, 0.1, 0.1)));
}

TEST(OccupancyMap, PointsThatAreNotFiniteChangeNothing) {
  OccupancyMap with{OccupancyConfig{}}, without{OccupancyConfig{}};
  const float inf = std::numeric_limits<float>::infinity();
  EXPECT_EQ(
      with.insert(std::vector<Vector3f>{{kNan, 0, 0}, {5, 1, 0}, {inf, 0, 0}, {0, kNan, -inf}},
                  SE3::Identity(), 1)
          .points,
      1);
  EXPECT_EQ(without.insert(std::vector<Vector3f>{{5, 1, 0}}, SE3::Identity(), 1).points, 1);
  EXPECT_TRUE(nodes(with.tree()) == nodes(without.tree()));
}

TEST(OccupancyMap, ThePointsOfTheVehiclesBodyAreLeftOut) {
  OccupancyMap map{OccupancyConfig{}};
  const auto report = map.insert(std::vector<Vector3f>{{0.3f, 0.2f, -0.1f}}, SE3::Identity(), 1);
  EXPECT_EQ(report.own_points, 1);
  EXPECT_EQ(report.points, 0);
  EXPECT_EQ(map.tree().size(), 0u);
}

TEST(OccupancyMap, APointBeyondTheRangeClearsUpToItAndOccupiesNothing) {
  OccupancyMap map{OccupancyConfig{}};
  map.insert(std::vector<Vector3f>{{40, 0, 0}}, pose({0.1, 0.1, 0.1}, 0), 1);
  const OccupancyGrid grid = map.block({-1, 0, 0}, {50, 0, 0});
  EXPECT_EQ(grid.at({14.5, 0.1, 0.1}), Cell::free);
  EXPECT_EQ(grid.at({15.5, 0.1, 0.1}), Cell::unknown);
  EXPECT_EQ(std::count(grid.cells.begin(), grid.cells.end(), Cell::occupied), 0);
}

TEST(OccupancyMap, WhatWasHitForLongIsFreeAfterAtMostTenScansThatSeeThroughIt) {
  OccupancyMap map{OccupancyConfig{}};
  Time stamp = 0;
  for (int i = 0; i < 60; ++i)
    map.insert(std::vector<Vector3f>{{5, 0, 0}}, pose({0.1, 0.1, 0.1}, 0), ++stamp);
  int scans = 0;
  while (map.block({5.1, 0.1, 0.1}, {5.1, 0.1, 0.1}).cells[0] == Cell::occupied && scans < 100) {
    map.insert(std::vector<Vector3f>{{9, 0, 0}}, pose({0.1, 0.1, 0.1}, 0), ++stamp);
    ++scans;
  }
  EXPECT_EQ(scans, 6);  // 0.6 s at 10 Hz
}

TEST(OccupancyMap, WhatWasFreeForLongIsOccupiedByTheNextScanThatHitsIt) {
  OccupancyMap map{OccupancyConfig{}};
  Time stamp = 0;
  for (int i = 0; i < 60; ++i)
    map.insert(std::vector<Vector3f>{{9, 0, 0}}, pose({0.1, 0.1, 0.1}, 0), ++stamp);
  EXPECT_EQ(map.block({5.1, 0.1, 0.1}, {5.1, 0.1, 0.1}).cells[0], Cell::free);
  map.insert(std::vector<Vector3f>{{5, 0, 0}}, pose({0.1, 0.1, 0.1}, 0), ++stamp);
  EXPECT_EQ(map.block({5.1, 0.1, 0.1}, {5.1, 0.1, 0.1}).cells[0], Cell::occupied);
}

TEST(OccupancyMap, ABlockSaysOfEveryCellWhatTheTreeSays) {
  OccupancyMap map{OccupancyConfig{}};
  core::Rng rng(4);
  const SE3 T = pose({1, 2, 2}, 0);
  for (Time stamp = 1; stamp < 4; ++stamp)
    map.insert(made::scan(made::yard(), T, {}, rng), T, stamp);
  const OccupancyGrid grid = map.block({-7.3, -9.1, -1}, {13.1, 8, 5.2});
  EXPECT_EQ(grid.stamp, 3);
  EXPECT_EQ(grid.size, Eigen::Vector3i(83, 70, 25));
  int known = 0;
  for (int z = 0; z < grid.size.z(); ++z)
    for (int y = 0; y < grid.size.y(); ++y)
      for (int x = 0; x < grid.size.x(); ++x) {
        const Vector3d p = grid.centre_of({x, y, z});
        const octomap::OcTreeNode* node = map.tree().search(p.x(), p.y(), p.z());
        const Cell said = !node                             ? Cell::unknown
                          : map.tree().isNodeOccupied(node) ? Cell::occupied
                                                            : Cell::free;
        ASSERT_EQ(grid.at(p), said) << p.transpose();
        known += node != nullptr;
      }
  EXPECT_GT(known, 10000);
}

TEST(OccupancyMap, ScansOutOfOrderOrWithoutAPlaceChangeNothing) {
  OccupancyMap map{OccupancyConfig{}};
  const std::vector<Vector3f> points{{5, 0, 0}}, others{{0, 5, 0}};
  map.insert(points, SE3::Identity(), 100);
  const auto before = nodes(map.tree());
  EXPECT_EQ(map.insert(others, SE3::Identity(), 100).status, InsertStatus::not_newer);
  EXPECT_EQ(map.insert(others, pose({kNan, 0, 0}, 0), 200).status, InsertStatus::bad_pose);
  EXPECT_EQ(map.insert(others, pose({1e9, 0, 0}, 0), 200).status, InsertStatus::bad_pose);
  EXPECT_EQ(map.insert(others, pose({0, -8190, 0}, 0), 200).status, InsertStatus::bad_pose);
  EXPECT_TRUE(nodes(map.tree()) == before);
  EXPECT_EQ(map.stamp(), 100);
}

TEST(OccupancyMap, WhatIsFarIsDroppedAndCountedAndWhatIsNearStays) {
  OccupancyConfig config;
  config.keep_radius_m = 20;
  config.drop_every_s = 0;
  OccupancyMap map(config), fresh(config);
  core::Rng rng(5);
  made::Beams beams;
  beams.columns = 128;
  const auto first = made::scan(made::yard(), pose({0, 0, 2}, 0), beams, rng);
  map.insert(first, pose({0, 0, 2}, 0), 1);
  const std::size_t nodes_before = map.tree().size();
  const auto report = map.insert({}, pose({18, 0, 2}, 0), 2);
  EXPECT_GT(report.dropped, 0u);
  EXPECT_EQ(report.nodes + report.dropped, nodes_before);
  EXPECT_EQ(map.tree().calcNumNodes(), report.nodes);
  fresh.insert(first, pose({0, 0, 2}, 0), 1);
  int kept = 0;
  for (auto leaf = fresh.tree().begin_leafs(); leaf != fresh.tree().end_leafs(); ++leaf) {
    const Vector3d p(leaf.getX(), leaf.getY(), leaf.getZ());
    const double distance = (p - Vector3d(18, 0, 2)).norm(), half = leaf.getSize() * 0.87;
    const bool there = map.tree().search(p.x(), p.y(), p.z()) != nullptr;
    if (distance < 20 - half) {
      EXPECT_TRUE(there) << p.transpose();
    } else if (distance > 20 + half) {
      EXPECT_FALSE(there) << p.transpose();
    }
    kept += there;
  }
  EXPECT_GT(kept, 1000);
}

TEST(OccupancyMap, ALongFlightStaysUnderTheCeilingOfNodes) {
  OccupancyConfig config;
  config.max_nodes = 60000;
  OccupancyMap map(config);
  core::Rng rng(6);
  made::Beams beams;
  beams.columns = 128;
  std::size_t dropped = 0;
  for (int i = 0; i < 60; ++i) {
    const SE3 T = pose({2.0 * i, 0, 2.1}, 0);
    const auto report = map.insert(made::scan({}, T, beams, rng), T, from_seconds(0.1 * (i + 1)));
    ASSERT_LE(report.nodes, 60000u);
    dropped += report.dropped;
    ASSERT_EQ(map.block(T.translation() + Vector3d(3, 0, 0), T.translation() + Vector3d(3, 0, 0))
                  .cells[0],
              Cell::free);
  }
  EXPECT_GT(dropped, 60000u);
}

TEST(OccupancyMap, EverythingGoesWhenTheVehicleIsElsewhere) {
  OccupancyMap map{OccupancyConfig{}};
  map.insert(std::vector<Vector3f>{{5, 0, 0}}, SE3::Identity(), 1);
  const auto report = map.insert({}, pose({500, 0, 0}, 0), from_seconds(10));
  EXPECT_EQ(report.nodes, 0u);
  map.insert(std::vector<Vector3f>{{5, 0, 0}}, pose({500, 0, 0}, 0), from_seconds(11));
  EXPECT_EQ(map.block({505.1, 0.1, 0.1}, {505.1, 0.1, 0.1}).cells[0], Cell::occupied);
}

TEST(OccupancyMap, AConfigurationOutOfBoundsIsAnErrorThatNamesTheKey) {
  OccupancyConfig config;
  config.keep_radius_m = 10;
  try {
    const OccupancyMap map(config);
    FAIL();
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("occupancy.keep_radius_m"), std::string::npos);
  }
}

}  // namespace
}  // namespace saker::occupancy
