/// One decision of PAMS, and its parts: the search over 30 samples at a horizon of 3 (all 24,360
/// paths, and a beam), with the current target alone and with its neighbours, and the decision as a
/// whole in a block of 40 m at 0.25 m. Aim: 100 ms on one thread. A tour of 1,000 stops: 1 s.
#include "../active/made_pams_flight.h"
#include "../active/tsplib.h"
#include "benchmark/benchmark.h"
#include "saker/core/rng.h"

namespace saker::active {
namespace {

using made::car;

PathProblem problem_of(int stops, int objects) {
  core::Rng rng(1);
  PathProblem problem;
  const Covariance prior = 0.25 * Eigen::Matrix4d::Identity();
  const Covariance common = 0.003 * Eigen::Matrix4d::Identity();
  problem.objects.assign(objects, Belief(prior, common));
  problem.drifted_m.assign(objects, 10);
  Eigen::MatrixXd places(stops, 2);
  for (double& x : places.reshaped()) x = 10 * rng.normal();
  for (int i = 0; i < stops; ++i) {
    auto& measurements = problem.stops.emplace_back();
    for (int object = 0; object < objects; ++object) {
      const double variance = 0.01 + 0.05 * rng.uniform();
      measurements.push_back({object, i, variance * Eigen::Matrix4d::Identity()});
    }
  }
  problem.to_m = problem.to_s = places.rowwise().norm();
  problem.on_s = problem.to_s;
  problem.between_m = Eigen::MatrixXd::Zero(stops, stops);
  for (int i = 0; i < stops; ++i) {
    for (int j = 0; j < stops; ++j) {
      problem.between_m(i, j) = (places.row(i) - places.row(j)).norm();
    }
  }
  problem.between_s = problem.between_m;
  problem.dwell_s = 1.5;
  problem.drift_m = 0.01;
  problem.price_per_s = 0.05;
  problem.horizon = 3;
  problem.beam = PamsConfig::saker().beam;
  return problem;
}

void all_paths(benchmark::State& state) {
  PathProblem problem = problem_of(30, static_cast<int>(state.range(0)));
  problem.most_paths = 1e9;
  for (auto _ : state) benchmark::DoNotOptimize(choose_path(problem));
}
BENCHMARK(all_paths)->ArgName("objects")->Arg(1)->Arg(4)->Unit(benchmark::kMillisecond);

void beam(benchmark::State& state) {
  PathProblem problem = problem_of(static_cast<int>(state.range(0)), 4);
  problem.most_paths = 1;
  PathChoice choice;
  for (auto _ : state) choice = choose_path(problem);
  state.counters["value"] = choice.best.value;
  state.counters["bound"] = choice.bound;
}
BENCHMARK(beam)->ArgName("stops")->Arg(30)->Arg(72)->Unit(benchmark::kMillisecond);

/// A row of parked cars, all in the map, of which none was looked at.
void decision(benchmark::State& state) {
  const PamsConfig pams = state.range(0) ? PamsConfig::saker() : PamsConfig::paper();
  std::vector<objects::Cuboid> cars;
  for (int i = 0; i < 30; ++i) cars.push_back(car(10 + 2.7 * i, 8, 1.57));
  const objects::ClassTable table;
  const ActiveConfig config;
  ActiveInput input;
  input.map = std::make_shared<const objects::ObjectMap>(made::map_of(cars));
  input.grid = made::shared(made::free_grid(20, 0.25));
  input.T_world_body.translation() = Eigen::Vector3d(0, 0, 3);
  std::size_t candidates = 0;
  for (auto _ : state) {
    state.PauseTiming();
    TargetTour targets = made::pams_tour(pams, TargetList(config.targets, table, *input.map),
                                         made::everywhere, made::oblique_model());
    input.stamp += kNanosecondsPerSecond;
    state.ResumeTiming();
    candidates = targets.plan(input, core::Budget::iterations(0)).candidates.size();
  }
  state.counters["lattice"] = static_cast<double>(candidates);
}
BENCHMARK(decision)->ArgName("saker")->Arg(0)->Arg(1)->Unit(benchmark::kMillisecond);

void tour(benchmark::State& state) {
  const tsplib::Instance instance = tsplib::pr1002();
  const TourProblem problem = tsplib::problem(instance.points);
  double length = 0;
  for (auto _ : state) {
    length = solve_tour(problem, {}, core::Budget::iterations(1'000'000)).length;
  }
  state.counters["of_optimum"] = length / instance.optimum;
}
BENCHMARK(tour)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace saker::active
