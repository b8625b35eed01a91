/// One plan in a 40 × 40 × 10 m block at 0.25 m with 60 or 120 trunks: median and p95 over 100
/// forests, in which the straight way is never free; and by how much deadlines are overrun.
#include <benchmark/benchmark.h>

#include <chrono>
#include <vector>

#include "../motion/made_world.h"
#include "saker/core/statistics.h"
#include "saker/motion/destination.h"
#include "saker/motion/free_space.h"
#include "saker/motion/search.h"

namespace saker::motion {
namespace {

constexpr int kForests = 100;
const Eigen::Vector3d kStart(-17, -17, 3), kGoal(17, 17, 4);
const MotionPlanner kPlanner{MotionConfig{}};

/// Everything that a sensor at the start sees no more of: the half of the block behind trunks.
void hide_far_corner(made::World& world) { world.hide(made::Box{{4, 4, 0}, {20, 20, 10}}); }

std::vector<PlanRequest> requests(int trunks, bool hidden) {
  std::vector<PlanRequest> made;
  for (std::uint64_t seed = 0; made.size() < kForests; ++seed) {
    made::World world = made::forest(seed, trunks);
    if (hidden) hide_far_corner(world);
    made.push_back(made::request(world, made::resting_at(kStart), kGoal, seed));
  }
  return made;
}

double milliseconds_since(std::chrono::steady_clock::time_point begin) {
  return 1e3 * std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

void plan_forest(benchmark::State& state) {
  const auto all = requests(static_cast<int>(state.range(0)), state.range(1) != 0);
  std::vector<double> times_ms, detours;
  std::size_t next = 0;
  int found = 0;
  for (auto _ : state) {
    const auto begin = std::chrono::steady_clock::now();
    const PlanResult result = kPlanner.plan(all[next++ % all.size()], made::ample());
    times_ms.push_back(milliseconds_since(begin));
    if (result.status != PlanStatus::ok) continue;
    ++found;
    const Eigen::Vector3d end = result.trajectory.states.back().position;
    detours.push_back(result.diagnostics.path_m / (end - kStart).norm());
  }
  state.counters["found"] = found;
  state.counters["median_ms"] = core::percentile(times_ms, 0.5);
  state.counters["p95_ms"] = core::percentile(times_ms, 0.95);
  state.counters["max_ms"] = core::percentile(times_ms, 1);
  state.counters["detour_median"] = core::percentile(detours, 0.5);
  state.counters["detour_p95"] = core::percentile(detours, 0.95);
}
BENCHMARK(plan_forest)
    ->ArgNames({"trunks", "hidden"})
    ->Args({60, 0})
    ->Args({120, 0})
    ->Args({60, 1})
    ->Iterations(kForests)
    ->Unit(benchmark::kMillisecond);

/// The parts that every plan pays for.
void field(benchmark::State& state) {
  const auto one = requests(60, false).front();
  for (auto _ : state) {
    const FreeSpace space(*one.grid, {}, kPlanner.geofence(), {.vehicle = kStart});
    benchmark::DoNotOptimize(space.free(kStart));
  }
}
BENCHMARK(field)->Unit(benchmark::kMillisecond);

void reachable(benchmark::State& state) {
  const auto one = requests(60, false).front();
  const FreeSpace space(*one.grid, {}, kPlanner.geofence(), {.vehicle = kStart});
  for (auto _ : state) benchmark::DoNotOptimize(reachable_cells(space, kStart, made::ample()));
}
BENCHMARK(reachable)->Unit(benchmark::kMillisecond);

/// How long after its deadline a plan comes back.
void overrun(benchmark::State& state) {
  const auto all = requests(120, true);
  const auto allowed = std::chrono::milliseconds(state.range(0));
  std::vector<double> late_ms;
  std::size_t next = 0;
  for (auto _ : state) {
    const auto deadline = std::chrono::steady_clock::now() + allowed;
    const auto budget = core::Budget::until(deadline, 1'000'000);
    benchmark::DoNotOptimize(kPlanner.plan(all[next++ % all.size()], budget));
    late_ms.push_back(milliseconds_since(deadline));
  }
  state.counters["late_p95_ms"] = core::percentile(late_ms, 0.95);
  state.counters["late_max_ms"] = core::percentile(late_ms, 1);
}
BENCHMARK(overrun)
    ->ArgName("deadline_ms")
    ->Arg(10)
    ->Arg(50)
    ->Arg(200)
    ->Iterations(50)
    ->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace saker::motion
