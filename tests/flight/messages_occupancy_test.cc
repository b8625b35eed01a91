#include <gtest/gtest.h>

#include <algorithm>

#include "flight/bus/occupancy_messages.h"
#include "saker/core/rng.h"

namespace saker::flight {
namespace {

using occupancy::Cell;
using occupancy::OccupancyGrid;

OccupancyGrid made_grid(const Eigen::Vector3i& size) {
  return {.stamp = 7'000'000'000,
          .resolution_m = 0.25,
          .origin = {-20, -20.25, -3},
          .size = size,
          .cells = std::vector<Cell>(static_cast<std::size_t>(size.prod()), Cell::unknown)};
}

/// What a vehicle sees: ground below, free above, boxes, unknown behind 18 m.
OccupancyGrid made_scene() {
  OccupancyGrid grid = made_grid({160, 160, 160});
  core::Rng rng(1);
  for (int z = 0; z < 160; ++z) {
    for (int y = 0; y < 160; ++y) {
      for (int x = 0; x < 160; ++x) {
        const double range = std::hypot(x - 80, y - 80);
        Cell& cell = grid.cells[grid.offset({x, y, z})];
        if (range > 72) continue;
        cell = z < 12 ? Cell::unknown : z == 12 || rng.chance(0.01) ? Cell::occupied : Cell::free;
      }
    }
  }
  return grid;
}

std::optional<OccupancyGrid> joined(const std::vector<occupancy_t>& chunks) {
  OccupancyJoiner joiner;
  std::optional<OccupancyGrid> whole;
  for (const occupancy_t& chunk : chunks) {
    if (auto grid = joiner.add(chunk)) whole = std::move(grid);
  }
  return whole;
}

void expect_same(const OccupancyGrid& a, const std::optional<OccupancyGrid>& b) {
  ASSERT_TRUE(b);
  EXPECT_EQ(a.stamp, b->stamp);
  EXPECT_EQ(a.resolution_m, b->resolution_m);
  EXPECT_EQ(a.origin, b->origin);
  EXPECT_EQ(a.size, b->size);
  EXPECT_TRUE(a.cells == b->cells);
}

TEST(OccupancyMessages, ASceneComesBackCellByCell) {
  const OccupancyGrid scene = made_scene();
  const auto chunks = to_lcm(scene, 0);
  EXPECT_LE(chunks.size(), 6u);  // a quarter of a megabyte at most
  for (const occupancy_t& chunk : chunks) EXPECT_LE(chunk.getEncodedSize(), 60 * 1024);
  expect_same(scene, joined(chunks));
}

TEST(OccupancyMessages, OneStateThroughoutIsAFewBytes) {
  const OccupancyGrid grid = made_grid({256, 256, 256});
  const auto chunks = to_lcm(grid, 0);
  ASSERT_EQ(chunks.size(), 1u);
  EXPECT_LE(chunks[0].runs.size(), 5u);
  expect_same(grid, joined(chunks));
}

TEST(OccupancyMessages, EveryLengthOfARunComesBack) {
  OccupancyGrid grid = made_grid({1, 1, 1});
  grid.cells.clear();
  for (const int length : {1, 2, 31, 32, 33, 34, 4095, 4096, 4097, 4098, 524288, 524289}) {
    const Cell state =
        grid.cells.empty() || grid.cells.back() != Cell::free ? Cell::free : Cell::occupied;
    grid.cells.insert(grid.cells.end(), static_cast<std::size_t>(length), state);
  }
  grid.size = {static_cast<int>(grid.cells.size()), 1, 1};
  expect_same(grid, joined(to_lcm(grid, 0)));
}

TEST(OccupancyMessages, NoiseTakesManyChunksAndComesBackInWhateverOrder) {
  OccupancyGrid grid = made_grid({100, 100, 60});
  core::Rng rng(2);
  for (Cell& cell : grid.cells) cell = static_cast<Cell>(rng.index(3));
  auto chunks = to_lcm(grid, 0);
  EXPECT_GT(chunks.size(), 4u);
  std::reverse(chunks.begin(), chunks.end());
  expect_same(grid, joined(chunks));
}

TEST(OccupancyMessages, WhatIsNoBlockIsNotSent) {
  EXPECT_TRUE(to_lcm(OccupancyGrid{}, 0).empty());
  OccupancyGrid grid = made_grid({4, 4, 4});
  grid.cells.pop_back();
  EXPECT_TRUE(to_lcm(grid, 0).empty());
  EXPECT_TRUE(to_lcm(made_grid({4096, 4097, 1}), 0).empty());
}

TEST(OccupancyJoiner, SizesThatAreNoneAreRefused) {
  for (const int wrong : {0, -1, 1 << 30}) {
    occupancy_t chunk = to_lcm(made_grid({4, 4, 4}), 0).front();
    chunk.size[1] = wrong;
    OccupancyJoiner joiner;
    EXPECT_FALSE(joiner.add(chunk));
    EXPECT_FALSE(joiner.accepted());
  }
}

TEST(OccupancyJoiner, RunsThatAreMoreOrLessThanTheBlockAreRefused) {
  const occupancy_t good = to_lcm(made_grid({4, 4, 4}), 0).front();
  for (const std::vector<std::uint8_t>& runs : {std::vector<std::uint8_t>{},
                                                {0x80},
                                                {0x03},
                                                {0x00},
                                                {0xff, 0xff, 0xff, 0xff, 0xff, 0xff},
                                                {0xff, 0xff, 0xff, 0x7f}}) {
    occupancy_t chunk = good;
    chunk.runs = runs;
    chunk.num_bytes = static_cast<std::int32_t>(runs.size());
    OccupancyJoiner joiner;
    EXPECT_FALSE(joiner.add(chunk));
    EXPECT_FALSE(joiner.accepted());
  }
}

TEST(OccupancyJoiner, ChunksThatDoNotFollowEachOtherAreRefused) {
  OccupancyGrid grid = made_grid({100, 100, 20});
  core::Rng rng(2);
  for (Cell& cell : grid.cells) cell = static_cast<Cell>(rng.index(3));
  auto chunks = to_lcm(grid, 0);
  ASSERT_GT(chunks.size(), 1u);
  chunks[1].first_cell += 1;
  chunks[1].num_cells -= 1;
  EXPECT_FALSE(joined(chunks));
}

}  // namespace
}  // namespace saker::flight
