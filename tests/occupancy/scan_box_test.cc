#include "saker/occupancy/scan_box.h"

#include <gtest/gtest.h>

#include "saker/core/rng.h"

namespace saker::occupancy {
namespace {

using octomap::point3d;
using Beams = std::vector<ScanBox::Beam>;

constexpr double kResolution = 0.25;
constexpr double kRange = 6;

Beams random_beams(int count) {
  core::Rng rng(1);
  Beams beams;
  const auto at = [&rng] { return static_cast<float>(rng.uniform(-8, 8)); };
  for (int i = 0; i < count; ++i) beams.push_back({point3d(at(), at(), at())});
  return beams;
}

KeyCube leaf(const octomap::OcTreeKey& key) { return {key[0], key[1], key[2], 1}; }

TEST(ScanBox, SeesTheSameCellsAsOctoMapsUpdate) {
  octomap::OcTree tree(kResolution);
  ScanBox box(kResolution, kRange);
  const point3d origin(0.3f, -0.2f, 0.7f);
  octomap::Pointcloud cloud;
  const Beams beams = random_beams(500);
  for (const ScanBox::Beam& beam : beams) cloud.push_back(beam.end);
  octomap::KeySet free_cells, occupied_cells;
  tree.computeUpdate(cloud, origin, free_cells, occupied_cells, kRange);
  box.collect(tree, origin, beams);
  const octomap::OcTreeKey centre = tree.coordToKey(origin);
  constexpr int kAround = 40;
  for (int z = -kAround; z <= kAround; ++z)
    for (int y = -kAround; y <= kAround; ++y)
      for (int x = -kAround; x <= kAround; ++x) {
        const octomap::OcTreeKey key(static_cast<octomap::key_type>(centre[0] + x),
                                     static_cast<octomap::key_type>(centre[1] + y),
                                     static_cast<octomap::key_type>(centre[2] + z));
        const int expected = occupied_cells.count(key) ? kOccupied
                             : free_cells.count(key)   ? kFree
                                                       : kUnseen;
        ASSERT_EQ(box.seen(leaf(key)), expected);
      }
}

TEST(ScanBox, ACubesBitsAreThoseOfItsEighths) {
  octomap::OcTree tree(kResolution);
  ScanBox box(kResolution, kRange);
  box.collect(tree, point3d(0.3f, -0.2f, 0.7f), random_beams(30));
  std::vector<KeyCube> cubes{{0, 0, 0, 1 << 16}};
  for (std::size_t i = 0; i < cubes.size() && cubes.size() < 100000; ++i) {
    std::uint8_t sum = kUnseen;
    for (int c = 0; c < 8; ++c) sum = static_cast<std::uint8_t>(sum | box.seen(cubes[i].child(c)));
    ASSERT_EQ(box.seen(cubes[i]), sum) << cubes[i].edge;
    for (int c = 0; c < 8; ++c)
      if (box.seen(cubes[i].child(c)) && cubes[i].edge > 2) cubes.push_back(cubes[i].child(c));
  }
  EXPECT_EQ(box.seen(cubes[0]), kFree | kOccupied);
}

TEST(ScanBox, ABeamClearsFromTheCellOfItsRangeOn) {
  octomap::OcTree tree(kResolution);
  ScanBox box(kResolution, kRange);
  const point3d origin(0.1f, 0.1f, 0.1f);
  box.collect(tree, origin, Beams{{point3d(100, 0.1f, 0.1f), 3.1f}});
  for (float x = 0.1f; x < 5.9f; x += 0.25f)
    EXPECT_EQ(box.seen(leaf(tree.coordToKey(point3d(x, 0.1f, 0.1f)))), x > 3 ? kFree : kUnseen)
        << x;
}

TEST(ScanBox, ABeamThatClearsFromBeyondTheBoxOnIsNotSeen) {
  octomap::OcTree tree(kResolution);
  ScanBox box(kResolution, kRange);
  box.collect(tree, point3d(0.1f, 0.1f, 0.1f),
              Beams{{point3d(100, 0, 0), 6}, {point3d(0, 100, 0), 90}});
  EXPECT_EQ(box.seen({0, 0, 0, 1 << 16}), kUnseen);
}

TEST(ScanBox, ForgetsTheScanBefore) {
  octomap::OcTree tree(kResolution);
  ScanBox box(kResolution, kRange);
  const point3d origin(0.1f, 0.1f, 0.1f);
  box.collect(tree, origin, Beams{{point3d(3, 0, 0)}});
  box.collect(tree, origin, Beams{{point3d(0, 3, 0)}});
  EXPECT_EQ(box.seen(leaf(tree.coordToKey(point3d(3, 0, 0)))), kUnseen);
  EXPECT_EQ(box.seen(leaf(tree.coordToKey(point3d(0, 3, 0)))), kOccupied);
  box.collect(tree, origin, {});
  EXPECT_EQ(box.seen({0, 0, 0, 1 << 16}), kUnseen);
}

TEST(ScanBox, DoesNotFitAtTheEdgeOfTheTree) {
  octomap::OcTree tree(kResolution);
  const ScanBox box(kResolution, kRange);
  EXPECT_TRUE(box.fits(tree, point3d(8000, -8000, 0)));
  EXPECT_FALSE(box.fits(tree, point3d(8190, 0, 0)));
  EXPECT_FALSE(box.fits(tree, point3d(0, -8190, 0)));
  EXPECT_FALSE(box.fits(tree, point3d(0, 0, 1e6f)));
}

}  // namespace
}  // namespace saker::occupancy
