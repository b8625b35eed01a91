/// A cycle of SLAM late in a flight: 600 keyframes, 100 objects (DESIGN section 3: at most 250 ms).
#include <benchmark/benchmark.h>

#include <numbers>

#include "../slam/made_world.h"

namespace saker::slam {
namespace {

using namespace made;

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

}  // namespace
}  // namespace saker::slam
