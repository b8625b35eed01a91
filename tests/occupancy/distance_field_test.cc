#include "saker/occupancy/distance_field.h"

#include <gtest/gtest.h>

#include "saker/core/rng.h"

namespace saker::occupancy {
namespace {

using Eigen::Vector3d;
using Eigen::Vector3i;

OccupancyGrid made_grid(const Vector3i& size, Cell cell) {
  OccupancyGrid grid;
  grid.resolution_m = 0.25;
  grid.origin = {-3, 2, -1};
  grid.size = size;
  grid.cells.assign(static_cast<std::size_t>(size.prod()), cell);
  return grid;
}

OccupancyGrid random_grid(std::uint64_t seed, double occupied, double unknown) {
  OccupancyGrid grid = made_grid({23, 17, 11}, Cell::free);
  core::Rng rng(seed);
  for (Cell& cell : grid.cells) {
    const double u = rng.uniform();
    cell = u < occupied ? Cell::occupied : u < occupied + unknown ? Cell::unknown : Cell::free;
  }
  return grid;
}

/// From a point to the nearest cell of one of two kinds, by looking at all of them.
double brute_force(const OccupancyGrid& grid, const Vector3d& p, Cell a, Cell b) {
  double nearest = std::numeric_limits<double>::infinity();
  for (int z = 0; z < grid.size.z(); ++z)
    for (int y = 0; y < grid.size.y(); ++y)
      for (int x = 0; x < grid.size.x(); ++x) {
        const Cell cell = grid.cells[grid.offset({x, y, z})];
        if (cell != a && cell != b) continue;
        const Vector3d off =
            ((grid.centre_of({x, y, z}) - p).cwiseAbs().array() - grid.resolution_m / 2)
                .cwiseMax(0);
        nearest = std::min(nearest, off.norm());
      }
  return nearest;
}

template <class Visit>
void for_each_cell(const OccupancyGrid& grid, Visit visit) {
  for (int z = 0; z < grid.size.z(); ++z)
    for (int y = 0; y < grid.size.y(); ++y)
      for (int x = 0; x < grid.size.x(); ++x) visit(Vector3i(x, y, z));
}

TEST(DistanceField, IsExactAtEveryCellsCentreUpToItsCap) {
  for (const double cap : {0.3, 1.0, 2.6}) {
    const OccupancyGrid grid = random_grid(1, 0.004, 0.3);
    const DistanceField field(grid, cap, UnknownCells::free);
    for_each_cell(grid, [&](const Vector3i& i) {
      const double truth = brute_force(grid, grid.centre_of(i), Cell::occupied, Cell::occupied);
      ASSERT_NEAR(field.of_cell(i), std::min(cap, truth), 1e-6);
    });
  }
}

TEST(DistanceField, TheUnknownAndWhatIsOutsideCountAsOccupiedWhenAsked) {
  const OccupancyGrid grid = random_grid(2, 0.002, 0.002);
  const DistanceField field(grid, 2, UnknownCells::occupied);
  for_each_cell(grid, [&](const Vector3i& i) {
    const Vector3d p = grid.centre_of(i);
    const Vector3d high = grid.origin + grid.resolution_m * grid.size.cast<double>();
    const double border = std::min((p - grid.origin).minCoeff(), (high - p).minCoeff());
    const double truth = brute_force(grid, p, Cell::occupied, Cell::unknown);
    ASSERT_NEAR(field.of_cell(i), std::min({2.0, truth, border}), 1e-6);
  });
  EXPECT_EQ(field.at({100, 0, 0}), 0);
}

TEST(DistanceField, AnywhereItIsNeverMoreThanTheTruthAndLessByACellsDiagonalAtMost) {
  const OccupancyGrid grid = random_grid(3, 0.003, 0);
  const DistanceField field(grid, 10, UnknownCells::free);
  core::Rng rng(4);
  const double diagonal = std::sqrt(3.0) * grid.resolution_m;
  for (int k = 0; k < 1000; ++k) {
    const Vector3d p =
        grid.origin + Vector3d(rng.uniform(0, 5.7), rng.uniform(0, 4.2), rng.uniform(0, 2.7));
    const double truth = brute_force(grid, p, Cell::occupied, Cell::occupied);
    ASSERT_LE(field.at(p), truth + 1e-6);
    ASSERT_GE(field.at(p), truth - diagonal - 1e-6);
  }
}

TEST(DistanceField, WhereNothingIsOccupiedItIsTheCap) {
  const OccupancyGrid grid = made_grid({10, 10, 10}, Cell::free);
  const DistanceField field(grid, 3, UnknownCells::free);
  EXPECT_EQ(field.of_cell({5, 5, 5}), 3);
  EXPECT_EQ(field.at({100, 0, 0}), 3);
}

TEST(DistanceField, ACapBeyondWhatItCanHoldIsCutToNinetyCells) {
  const OccupancyGrid grid = made_grid({200, 3, 3}, Cell::free);
  const DistanceField field(grid, 1000, UnknownCells::free);
  EXPECT_EQ(field.max_distance_m(), 22.5);
  EXPECT_NEAR(field.of_cell({100, 1, 1}), 22.5, 1e-6);
}

TEST(DistanceField, OfNoGridIsZeroEverywhere) {
  const DistanceField field;
  EXPECT_EQ(field.at({0, 0, 0}), 0);
}

TEST(DistanceField, APlaceThatIsNotFiniteIsOutside) {
  const DistanceField field(made_grid({4, 4, 4}, Cell::free), 2, UnknownCells::occupied);
  EXPECT_EQ(field.at({NAN, 0, 0}), 0);
}

}  // namespace
}  // namespace saker::occupancy
