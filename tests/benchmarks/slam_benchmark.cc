/// A cycle of SLAM late in a flight: 600 keyframes, 100 objects (DESIGN section 3: at most 250 ms).
/// What a second robot's history costs in the first one's graph.
#include <benchmark/benchmark.h>

#include <ctime>
#include <numbers>

#include "../multirobot/made_flights.h"

namespace saker::slam {
namespace {

using namespace made;
using multirobot::MergeReport;
using multirobot::MultiRobotSlam;

/// Rounds past 100 objects, a keyframe a metre, ten to fifteen objects in each window.
class Flight {
 public:
  explicit Flight(int keyframes, SlamConfig config = honest_config())
      : poses_(loop(keyframes / (6 * std::numbers::pi), 1.1, 5)),
        robot_(ring_of_objects(keyframes / (6 * std::numbers::pi), 50), {}, 1),
        slam_(config, {}) {
    while (static_cast<int>(slam_.keyframes().size()) < keyframes) step();
  }

  SlamUpdate step() {
    const std::size_t at = next_++ % poses_.size();
    return slam_.update(robot_.step(0.5 * static_cast<double>(next_), poses_[at]),
                        core::Budget::iterations(4));
  }
  [[nodiscard]] const Slam& slam() const { return slam_; }

 private:
  std::vector<SE3> poses_;
  Robot robot_;
  Slam slam_;
  std::size_t next_ = 0;
};

void slam_cycle(benchmark::State& state) {
  Flight flight(static_cast<int>(state.range(0)));
  SlamUpdate last;
  for (auto _ : state) last = flight.step();
  state.counters["keyframes"] = static_cast<double>(flight.slam().keyframes().size());
  state.counters["objects"] = last.confirmed;
  state.counters["measured"] = last.matched;
  state.counters["iterations"] = last.solve.iterations;
}

/// As long as a cycle can take: no step is small enough to end it early.
void slam_cycle_all_iterations(benchmark::State& state) {
  SlamConfig config = honest_config();
  config.graph.function_tolerance = 0;
  Flight flight(static_cast<int>(state.range(0)), config);
  SlamUpdate last;
  for (auto _ : state) last = flight.step();
  state.counters["iterations"] = last.solve.iterations;
}
BENCHMARK(slam_cycle_all_iterations)->Arg(600)->Iterations(5)->Unit(benchmark::kMillisecond);

BENCHMARK(slam_cycle)->Arg(100)->Arg(600)->Iterations(10)->Unit(benchmark::kMillisecond);

void slam_covariance(benchmark::State& state) {
  const Flight flight(static_cast<int>(state.range(0)));
  for (auto _ : state) benchmark::DoNotOptimize(flight.slam().map_with_covariance());
}
BENCHMARK(slam_covariance)->Arg(100)->Arg(600)->Iterations(2)->Unit(benchmark::kMillisecond);

struct Taken {
  MergeReport report;
  double seconds = 0;  ///< of the processor
};

Taken take(const Flown& flown, MultiRobotSlam& graph) {
  const PosePrior start{flown.T_town_odom, 1e-4 * Matrix6d::Identity()};
  const std::clock_t before = std::clock();
  const MergeReport report = graph.add(flown.history, start, core::Budget::iterations(10));
  return {report, static_cast<double>(std::clock() - before) / CLOCKS_PER_SEC};
}

/// Two robots fly the same round, there and back: `times_alone` is to be at most 2. On the longest
/// the second robot's drift opens a loop that its end closes in the first one's map.
void slam_second_history(benchmark::State& state) {
  const double radius = static_cast<double>(state.range(0)) / (2 * std::numbers::pi);
  const std::vector<TrueObject> world = ring_of_objects(radius, static_cast<int>(state.range(1)));
  const std::vector<SE3> round = loop(radius, 1.1);
  double alone = 0, merged = 0, loops = 0;
  std::uint64_t seed = 0;
  for (auto _ : state) {
    const Flown first = fly(world, round, {}, ++seed, 15, 0),
                second = fly(world, back(round), {}, ++seed, 15, 0);
    MultiRobotSlam empty({}, honest_config(), {}), both({}, honest_config(), {});
    alone += take(second, empty).seconds;
    (void)take(first, both);
    const Taken taken = take(second, both);
    merged += taken.seconds;
    loops += taken.report.loops;
    state.SetIterationTime(taken.seconds);
  }
  state.counters["times_alone"] = merged / alone;
  state.counters["loops"] = loops;
}
BENCHMARK(slam_second_history)
    ->ArgNames({"metres", "vehicles"})
    ->Args({300, 25})
    ->Args({300, 50})
    ->Args({660, 50})
    ->Iterations(5)
    ->UseManualTime()
    ->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace saker::slam
