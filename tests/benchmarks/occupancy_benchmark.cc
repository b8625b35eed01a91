/// A scan of 64 × 1024 into the octree at 0.25 m and 15 m: OctoMap's own insertion and ours (at
/// most 30 ms), over a flight of 20 scans at 2.5 m/s past parked vans, a wall and posts. Then what
/// is read from it: a block of 40 × 40 × 12 m (20 ms) and its distance field (50 ms).
#include <benchmark/benchmark.h>

#include <chrono>

#include "../occupancy/made_scan.h"
#include "../occupancy/stock.h"
#include "saker/core/statistics.h"
#include "saker/occupancy/distance_field.h"

namespace saker::occupancy {
namespace {

constexpr int kScans = 20;

/// In the yard about half of the rays end within the range; in the open all of them are 15 m long,
/// the most there can be.
enum World { kYard, kOpen };

made::BoxWorld world(World which) {
  if (which == kYard) return made::yard();
  return {{made::Box(Eigen::Vector3d(-40, -40, -40), Eigen::Vector3d(40, 40, -30)),
           made::Box(Eigen::Vector3d(-40, -40, -40), Eigen::Vector3d(-35, 40, 40)),
           made::Box(Eigen::Vector3d(35, -40, -40), Eigen::Vector3d(40, 40, 40)),
           made::Box(Eigen::Vector3d(-40, -40, -40), Eigen::Vector3d(40, -35, 40)),
           made::Box(Eigen::Vector3d(-40, 35, -40), Eigen::Vector3d(40, 40, 40))},
          false};
}

struct Flight {
  explicit Flight(World which) {
    core::Rng rng(1);
    for (int i = 0; i < kScans; ++i) {
      poses.push_back(made::pose({0.25 * i, 0.05 * i, 3}, 0.02 * i));
      scans.push_back(made::scan(world(which), poses.back(), {}, rng));
    }
  }
  std::vector<SE3> poses;
  std::vector<std::vector<Eigen::Vector3f>> scans;
};

const Flight& flight(std::int64_t which) {
  static const Flight flights[] = {Flight(kYard), Flight(kOpen)};
  return flights[which];
}

void stock_insertion(benchmark::State& state) {
  const Flight& flown = flight(state.range(0));
  const OccupancyConfig config;
  octomap::OcTree tree(config.resolution_m);
  made::configure(tree, config);
  std::size_t i = 0;
  for (auto _ : state) {
    made::insert(tree, config, flown.scans[i % kScans], flown.poses[i % kScans]);
    ++i;
  }
  state.counters["nodes"] = static_cast<double>(tree.size());
}
BENCHMARK(stock_insertion)
    ->Arg(kYard)
    ->Arg(kOpen)
    ->Iterations(kScans / 2)
    ->Unit(benchmark::kMillisecond);

void insertion(benchmark::State& state) {
  const Flight& flown = flight(state.range(0));
  OccupancyMap map{OccupancyConfig{}};
  std::vector<double> milliseconds;
  std::size_t i = 0;
  for (auto _ : state) {
    const auto start = std::chrono::steady_clock::now();
    map.insert(flown.scans[i % kScans], flown.poses[i % kScans],
               from_seconds(0.1 * static_cast<double>(i + 1)));
    const std::chrono::duration<double, std::milli> took = std::chrono::steady_clock::now() - start;
    milliseconds.push_back(took.count());
    ++i;
  }
  state.counters["median_ms"] = core::median(milliseconds);
  state.counters["p95_ms"] = core::percentile(milliseconds, 0.95);
  state.counters["first_ms"] = milliseconds.front();
  state.counters["nodes"] = static_cast<double>(map.tree().size());
}
BENCHMARK(insertion)->Arg(kYard)->Arg(kOpen)->Iterations(5 * kScans)->Unit(benchmark::kMillisecond);

OccupancyMap flown() {
  OccupancyMap map{OccupancyConfig{}};
  for (int i = 0; i < kScans; ++i)
    map.insert(flight(kYard).scans[i], flight(kYard).poses[i],
               from_seconds(0.1 * static_cast<double>(i + 1)));
  return map;
}

OccupancyGrid block_of(const OccupancyMap& map) {
  return map.block({-15, -19, -3}, {24.9, 20.9, 8.9});
}

void block(benchmark::State& state) {
  const OccupancyMap map = flown();
  for (auto _ : state) benchmark::DoNotOptimize(block_of(map));
}
BENCHMARK(block)->Unit(benchmark::kMillisecond);

void distance_field(benchmark::State& state) {
  const OccupancyGrid grid = block_of(flown());
  for (auto _ : state)
    benchmark::DoNotOptimize(
        DistanceField(grid, static_cast<double>(state.range(0)), UnknownCells::occupied));
  state.counters["cells"] = static_cast<double>(grid.cells.size());
}
BENCHMARK(distance_field)->Arg(2)->Arg(5)->Arg(10)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace saker::occupancy
