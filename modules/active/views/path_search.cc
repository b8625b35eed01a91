#include "saker/active/views/path_search.h"

#include <algorithm>
#include <limits>
#include <utility>

namespace saker::active {
namespace {

constexpr double kTie = 1e-9;    // nat: gains that differ by less differ by rounding
constexpr double kWhole = 1e15;  // up to here a double counts

/// A path as far as it has come.
struct State {
  Path path;
  double flown_s = 0, flown_m = 0;
  std::vector<Belief> beliefs;
  std::vector<std::pair<int, int>> seen;  ///< objects' cells
};

bool better(const Path& a, const Path& b) {
  if (std::abs(a.value - b.value) > kTie) return a.value > b.value;
  return a.detour_s < b.detour_s - kTie;
}

bool contains(const std::vector<int>& stops, int stop) {
  return std::find(stops.begin(), stops.end(), stop) != stops.end();
}

/// m², of x and y since the object was first seen.
double drift(const CellMeasurement& measurement, double flown_m, const PathProblem& problem) {
  return problem.drift_m * problem.drift_m * (problem.drifted_m[measurement.object] + flown_m);
}

void measure(State& state, const CellMeasurement& measurement, const PathProblem& problem) {
  const std::pair<int, int> cell(measurement.object, measurement.cell);
  if (std::find(state.seen.begin(), state.seen.end(), cell) != state.seen.end()) return;
  state.seen.push_back(cell);
  Belief& belief = state.beliefs[measurement.object];
  const double before = belief.entropy();
  belief.add(information_of(measurement.measured, drift(measurement, state.flown_m, problem)));
  state.path.gain += before - belief.entropy();
}

State extended(const State& state, int stop, const PathProblem& problem) {
  State next = state;
  const bool begins = state.path.stops.empty();
  const int last = begins ? -1 : state.path.stops.back();
  next.flown_m += begins ? problem.to_m[stop] : problem.between_m(last, stop);
  next.flown_s += (begins ? problem.to_s[stop] : problem.between_s(last, stop)) + problem.dwell_s;
  next.path.stops.push_back(stop);
  for (const CellMeasurement& measurement : problem.stops[stop])
    measure(next, measurement, problem);
  next.path.detour_s = next.flown_s + problem.on_s[stop] - problem.direct_s;
  next.path.value = next.path.gain - problem.price_per_s * next.path.detour_s;
  return next;
}

State beginning(const PathProblem& problem) { return {{}, 0, 0, problem.objects, {}}; }

void enumerate(const State& state, const PathProblem& problem, std::size_t length,
               PathChoice& choice) {
  if (better(state.path, choice.best)) choice.best = state.path;
  if (state.path.stops.size() == length) {
    ++choice.paths;
    return;
  }
  for (int stop = 0; stop < static_cast<int>(problem.stops.size()); ++stop) {
    if (!contains(state.path.stops, stop)) {
      enumerate(extended(state, stop, problem), problem, length, choice);
    }
  }
}

void keep_best(std::vector<State>& states, int most) {
  const auto order = [](const State& a, const State& b) { return better(a.path, b.path); };
  std::stable_sort(states.begin(), states.end(), order);
  if (static_cast<int>(states.size()) > most) states.erase(states.begin() + most, states.end());
}

void search_by_beam(const State& start, const PathProblem& problem, std::size_t length,
                    PathChoice& choice) {
  std::vector<State> beam = {start};
  for (std::size_t stops = start.path.stops.size(); stops < length; ++stops) {
    std::vector<State> longer;
    for (const State& state : beam) {
      for (int stop = 0; stop < static_cast<int>(problem.stops.size()); ++stop) {
        if (!contains(state.path.stops, stop)) longer.push_back(extended(state, stop, problem));
      }
      keep_best(longer, problem.beam);
    }
    beam = std::move(longer);
    if (better(beam.front().path, choice.best)) choice.best = beam.front().path;
  }
  choice.paths = static_cast<long>(beam.size());
}

/// Σ of the single gains of a stop, if nothing were common and nothing drifted.
double most_gain(const PathProblem& problem, int stop, const std::vector<Belief>& beliefs) {
  double sum = 0;
  for (const CellMeasurement& measurement : problem.stops[stop]) {
    sum += beliefs[measurement.object].most_gain(information_of(measurement.measured, 0));
  }
  return sum;
}

/// The bound of `choose_path`, from the stops of S.
double bound_from(PathProblem problem, const std::vector<int>& stops_of_s, std::size_t length) {
  problem.drift_m = 0;
  const std::vector<Belief> beliefs = after(problem, stops_of_s);
  std::vector<double> gains;
  for (int stop = 0; stop < static_cast<int>(problem.stops.size()); ++stop) {
    gains.push_back(most_gain(problem, stop, beliefs));
  }
  std::sort(gains.rbegin(), gains.rend());
  double gain = path_through(problem, stops_of_s).gain, bound = 0;
  for (std::size_t k = 0; k < length; ++k) {
    gain += gains[k];
    bound =
        std::max(bound, gain - problem.price_per_s * problem.dwell_s * static_cast<double>(k + 1));
  }
  return bound;
}

}  // namespace

double variations(int a, int T) {
  double count = 1;
  for (int i = 0; i < T; ++i) count *= std::max(a - i, 0);
  return count < kWhole ? count : std::numeric_limits<double>::infinity();
}

PathChoice choose_path(const PathProblem& problem, std::optional<int> first) {
  const int stops = static_cast<int>(problem.stops.size());
  const int length = std::min(problem.horizon, stops);
  State start = beginning(problem);
  PathChoice choice;
  if (first) {
    start = extended(start, *first, problem);
    choice.best = start.path;
  }
  const double paths = first ? variations(stops - 1, length - 1) : variations(stops, length);
  choice.exhaustive = paths <= problem.most_paths;
  if (choice.exhaustive) {
    enumerate(start, problem, length, choice);
    choice.bound = choice.best.value;
  } else {
    search_by_beam(start, problem, length, choice);
    choice.bound =
        std::min(bound_from(problem, {}, length), bound_from(problem, choice.best.stops, length));
  }
  return choice;
}

Path path_through(const PathProblem& problem, const std::vector<int>& stops) {
  State state = beginning(problem);
  for (const int stop : stops) state = extended(state, stop, problem);
  return state.path;
}

std::vector<Belief> after(const PathProblem& problem, const std::vector<int>& stops) {
  State state = beginning(problem);
  for (const int stop : stops) state = extended(state, stop, problem);
  return state.beliefs;
}

}  // namespace saker::active
