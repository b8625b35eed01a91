#include "slam/merge.h"

#include <algorithm>
#include <map>

#include "slam/landmark_estimate.h"

namespace saker::slam {
namespace {

/// A history's measurement stands for many windows: its class may be as sure as they made it.
constexpr double kClassClamp = 1e-6;
constexpr std::size_t kMostMeasurements = 5000;  // of one entry: an object map makes one
constexpr double kSure = 1;                      // shape probability: its robot believed in it
constexpr double kToSettle = 0.3;                // of the time: the final solves of the whole graph
constexpr std::size_t kYoung = 10;  // observations of an object whose first may have been a part

bool is_of(const MergedFlight& flight, const History& history) {
  return flight.robot == history.robot && flight.flight == history.flight;
}

bool finite(const HistoryEntry& entry) {
  return entry.T_odom_lidar.matrix().allFinite() && entry.stamp >= 0;
}

/// Of what is new: in order, finite, and with motions that weigh something.
bool usable(const std::vector<HistoryEntry>& entries, std::size_t from) {
  for (std::size_t k = from; k < entries.size(); ++k) {
    if (!finite(entries[k])) return false;
    if (k == 0) continue;
    const Matrix6d& motion = entries[k].motion_covariance;
    if (entries[k].stamp <= entries[k - 1].stamp || !motion.allFinite()) return false;
    if (motion.llt().info() != Eigen::Success) return false;
  }
  return true;
}

std::vector<Landmark*> pointers(std::vector<Landmark>& landmarks) {
  std::vector<Landmark*> all;
  for (Landmark& landmark : landmarks) all.push_back(&landmark);
  return all;
}

/// What is known of the pose of odometry's frame, of its first keyframe.
PosePrior of_first_keyframe(const PosePrior& T_world_odom, const SE3& T_odom_lidar) {
  const Matrix6d A = core::se3_adjoint(T_odom_lidar.inverse());
  return {T_world_odom.pose * T_odom_lidar, A * T_world_odom.covariance * A.transpose()};
}

bool seen_from(const Landmark& landmark, int chain, int serial) {
  return std::ranges::any_of(landmark.observations, [&](const Observation& o) {
    return o.chain == chain && o.keyframe >= serial;
  });
}

bool newer(const Landmark& landmark, int chain, int serial) {
  return std::ranges::all_of(landmark.observations, [&](const Observation& o) {
    return o.chain == chain && o.keyframe >= serial;
  });
}

}  // namespace

MultiRobotSlam::MultiRobotSlam(const SlamConfig& config, const objects::ClassTable& table)
    : config_(core::checked(config, "slam")), landmark_config_(config.landmarks), table_(table) {
  landmark_config_.class_clamp = kClassClamp;
}

MergeReport MultiRobotSlam::add(const History& history,
                                const std::optional<PosePrior>& T_world_odom,
                                const core::Budget& budget) {
  const double given_s = budget.seconds_left();
  MergeReport report;
  std::size_t chain = 0;
  while (chain < flights_.size() && !is_of(flights_[chain], history)) ++chain;
  const std::size_t from = chain < flights_.size() ? flights_[chain].keyframes.size() : 0;
  if (history.entries.size() <= from) report.status = MergeStatus::nothing_new;
  if (!usable(history.entries, from)) report.status = MergeStatus::invalid;
  if (report.status != MergeStatus::merged) return report;
  if (chain == flights_.size()) {
    const std::optional<PosePrior> start = take_off(history, T_world_odom, budget, report);
    if (report.status != MergeStatus::merged) return report;
    flights_.push_back({history.robot, history.flight, start, {}});
  }
  for (std::size_t k = from; k < history.entries.size(); ++k) {
    append(flights_[chain], history.entries[k]);
    integrate(history.entries[k], static_cast<int>(chain), report);
    ++report.entries;
    if (report.entries % config_.merge.track_every == 0) track(chain);
    if (report.entries % config_.merge.loop_every == 0) close_loop(chain, report);
    if (budget.seconds_left() < kToSettle * given_s) break;
  }
  track(chain);
  close_loop(chain, report);
  settle(chain, budget, report);
  return report;
}

/// Of the first keyframe; none where this flight is to hold the frame.
std::optional<PosePrior> MultiRobotSlam::take_off(const History& history,
                                                  const std::optional<PosePrior>& T_world_odom,
                                                  const core::Budget& budget,
                                                  MergeReport& report) const {
  const SE3& T_odom_lidar = history.entries.front().T_odom_lidar;
  if (T_world_odom) return of_first_keyframe(*T_world_odom, T_odom_lidar);
  if (flights_.empty()) return std::nullopt;
  MultiRobotSlam alone(config_, table_);
  (void)alone.add(history, std::nullopt, budget);
  report.alignment = align(survey(), alone.survey(), config_.merge.constellation);
  if (report.alignment.status == AlignmentStatus::accepted)
    return of_first_keyframe(report.alignment.T_a_b, T_odom_lidar);
  report.status = MergeStatus::not_aligned;
  return std::nullopt;
}

void MultiRobotSlam::append(MergedFlight& flight, const HistoryEntry& entry) {
  Keyframe keyframe{static_cast<int>(flight.keyframes.size()), entry.stamp, entry.T_odom_lidar,
                    entry.T_odom_lidar, entry.motion_covariance};
  if (!flight.keyframes.empty()) {
    const Keyframe& before = flight.keyframes.back();
    keyframe.T_world_lidar =
        before.T_world_lidar * before.T_odom_lidar.inverse() * entry.T_odom_lidar;
  } else if (flight.prior) {
    keyframe.T_world_lidar = flight.prior->pose;
  }
  flight.keyframes.push_back(keyframe);
}

std::vector<Candidate> MultiRobotSlam::candidates(const HistoryEntry& entry, int chain, bool moving,
                                                  MergeReport& report) const {
  const SE3& T_world_lidar =
      flights_[static_cast<std::size_t>(chain)].keyframes.back().T_world_lidar;
  std::vector<Candidate> all;
  for (const objects::Measurement& measurement : entry.measurements) {
    if (measurement.moving != moving) continue;
    const bool fits =
        measurement.class_probability.size() == static_cast<std::size_t>(table_.size()) &&
        valid({measurement.model, measurement.covariance});
    if (!fits || all.size() >= kMostMeasurements) {
      ++report.refused;
      continue;
    }
    all.push_back({&measurement,
                   {measurement.model, measurement.covariance},
                   objects::transformed(T_world_lidar, measurement.model),
                   objects::place(measurement.model).norm(),
                   kSure,
                   chain});
  }
  return all;
}

void MultiRobotSlam::integrate(const HistoryEntry& entry, int chain, MergeReport& report) {
  take_back(candidates(entry, chain, true, report), chain);
  const std::vector<Candidate> seen = candidates(entry, chain, false, report);
  const std::vector<int> landmark_of = associate(seen, landmarks_, table_, config_.association);
  const std::vector<Chain> all = chains();
  const int serial = flights_[static_cast<std::size_t>(chain)].keyframes.back().serial;
  for (std::size_t c = 0; c < seen.size(); ++c) {
    if (landmark_of[c] < 0) {
      ++report.created;
      landmarks_.push_back(new_landmark(next_id_++, seen[c], serial, landmark_config_));
      continue;
    }
    ++report.matched;
    Landmark& landmark = landmarks_[static_cast<std::size_t>(landmark_of[c])];
    observe(landmark, seen[c], serial, landmark_config_);
    if (landmark.observations.size() <= kYoung) restart_if_better(landmark, all, config_.graph);
  }
}

/// What a robot told of an object that turned out to move is void.
void MultiRobotSlam::take_back(const std::vector<Candidate>& moving, int chain) {
  const std::vector<int> landmark_of = associate(moving, landmarks_, table_, config_.association);
  for (const int l : landmark_of) {
    if (l < 0) continue;
    std::erase_if(landmarks_[static_cast<std::size_t>(l)].observations,
                  [&](const Observation& o) { return o.chain == chain; });
  }
  std::erase_if(landmarks_, [](const Landmark& l) { return l.observations.empty(); });
}

std::vector<Chain> MultiRobotSlam::chains() {
  std::vector<Chain> all;
  for (MergedFlight& flight : flights_) all.push_back({&flight.keyframes, flight.prior});
  return all;
}

void MultiRobotSlam::track(std::size_t chain) {
  const auto newest = static_cast<std::size_t>(config_.merge.track_keyframes);
  std::vector<Chain> all = chains();
  for (Chain& each : all) each.free_from = each.keyframes->size();
  if (all[chain].free_from < 2) return;
  all[chain].free_from -= std::min(all[chain].free_from, newest);
  const auto free_from = static_cast<int>(all[chain].free_from);
  std::vector<Landmark*> seen;
  for (Landmark& landmark : landmarks_) {
    if (seen_from(landmark, static_cast<int>(chain), free_from)) seen.push_back(&landmark);
  }
  (void)solve_graph(all, seen, config_.graph,
                    core::Budget::iterations(config_.merge.track_iterations));
}

/// Where there is one, poses and objects are put about where they belong, and the rest follows.
void MultiRobotSlam::close_loop(std::size_t chain, MergeReport& report) {
  std::vector<Keyframe>& keyframes = flights_[chain].keyframes;
  const int since = static_cast<int>(keyframes.size()) - config_.merge.loop_keyframes;
  if (since <= 0) return;
  std::vector<const Landmark*> recent, older;
  for (const Landmark& landmark : landmarks_) {
    if (!seen_from(landmark, static_cast<int>(chain), since)) older.push_back(&landmark);
    if (newer(landmark, static_cast<int>(chain), since)) recent.push_back(&landmark);
  }
  const auto is_recent = [&](std::size_t c, const Keyframe& k) {
    return c == chain && k.serial >= since;
  };
  const AlignmentBounds bounds{config_.merge.loop_shift_m, config_.merge.loop_turn_deg};
  const Alignment loop =
      align(survey(older, [&](std::size_t c, const Keyframe& k) { return !is_recent(c, k); }),
            survey(recent, is_recent), config_.merge.constellation, bounds);
  if (loop.status != AlignmentStatus::accepted) return;
  ++report.loops;
  for (std::size_t k = static_cast<std::size_t>(since); k < keyframes.size(); ++k)
    keyframes[k].T_world_lidar = loop.T_a_b.pose * keyframes[k].T_world_lidar;
  join(loop);
  spread();
}

/// Over all flights, what closing a loop moved one's end by: any of them may have drifted, and one
/// that was bent to fit the others' drift would have to be bent back.
void MultiRobotSlam::spread() {
  (void)solve_graph(chains(), pointers(landmarks_), whole_graph(config_.merge.first_scale),
                    core::Budget::iterations(config_.merge.iterations));
}

/// One flight and what it saw, the other flights held.
SolveReport MultiRobotSlam::solve_flight(std::size_t chain, double scale,
                                         const core::Budget& budget) {
  std::vector<Chain> all = chains();
  for (std::size_t c = 0; c < all.size(); ++c)
    if (c != chain) all[c].free_from = all[c].keyframes->size();
  std::vector<Landmark*> seen;
  for (Landmark& landmark : landmarks_)
    if (seen_from(landmark, static_cast<int>(chain), 0)) seen.push_back(&landmark);
  return solve_graph(all, seen, whole_graph(scale), budget);
}

/// Recent objects follow the correction; those that are old ones become one with them.
void MultiRobotSlam::join(const Alignment& loop) {
  for (const auto& [older, recent] : loop.matches) {
    const auto a = std::ranges::find(landmarks_, older, &Landmark::id);
    const auto b = std::ranges::find(landmarks_, recent, &Landmark::id);
    b->model = objects::transformed(loop.T_a_b.pose, b->model);
    absorb(*a, *b);
    landmarks_.erase(b);
  }
}

GraphConfig MultiRobotSlam::whole_graph(double scale) const {
  GraphConfig graph = config_.graph;
  graph.iterations = config_.merge.iterations;
  graph.trust_radius = config_.merge.trust_radius;
  graph.robust_scale *= scale;
  return graph;
}

/// The others have settled: while the kernel is wide only this flight moves. What it took for new
/// because it had drifted lies on what it is by then.
SolveReport MultiRobotSlam::solve_narrowing(std::size_t chain, const core::Budget& budget) {
  for (double scale = config_.merge.first_scale; scale > 1; scale /= 2)
    (void)solve_flight(chain, scale, budget);
  (void)merge_duplicates(landmarks_, config_.duplicates, landmark_config_);
  return solve_graph(chains(), pointers(landmarks_), whole_graph(1), budget);
}

void MultiRobotSlam::settle(std::size_t chain, const core::Budget& budget, MergeReport& report) {
  report.solve = solve_narrowing(chain, budget);
  const int joined = merge_duplicates(landmarks_, config_.duplicates, landmark_config_);
  const int apart = split();
  // Two objects cannot stand on one ground: there a flight mismeasured the one that it saw.
  const int rejoined = merge_duplicates(landmarks_, config_.duplicates, landmark_config_);
  report.split = apart - rejoined;
  if (joined + apart > 0)
    report.solve = solve_graph(chains(), pointers(landmarks_), whole_graph(1), budget);
}

/// Where one flight's measurements of an object lie far from those of another flight they are of
/// another object.
int MultiRobotSlam::split() {
  const std::vector<Chain> all = chains();
  std::vector<Landmark> apart;
  for (Landmark& landmark : landmarks_) {
    for (const int chain : disagreeing(landmark, all)) {
      Landmark other = landmark;
      other.id = next_id_++;
      std::erase_if(other.observations, [&](const Observation& o) { return o.chain != chain; });
      std::erase_if(landmark.observations, [&](const Observation& o) { return o.chain == chain; });
      (void)refine(other, all, config_.graph);
      apart.push_back(std::move(other));
    }
  }
  std::ranges::move(apart, std::back_inserter(landmarks_));
  return static_cast<int>(apart.size());
}

std::vector<int> MultiRobotSlam::disagreeing(const Landmark& landmark, Chains chains) const {
  struct Sum {
    double weight = 0, count = 0;
  };
  std::map<int, Sum> of_chain;
  const std::vector<double> weights = robust_weights(landmark, chains, config_.graph);
  for (std::size_t i = 0; i < weights.size(); ++i) {
    Sum& sum = of_chain[landmark.observations[i].chain];
    sum.weight += weights[i];
    ++sum.count;
  }
  double best = 0;
  for (const auto& [chain, sum] : of_chain) best = std::max(best, sum.weight / sum.count);
  std::vector<int> apart;
  for (const auto& [chain, sum] : of_chain) {
    const double mean = sum.weight / sum.count;
    if (mean < config_.merge.disagreement && mean < config_.merge.disagreement * best)
      apart.push_back(chain);
  }
  return apart;
}

Survey MultiRobotSlam::survey(const std::vector<const Landmark*>& landmarks,
                              const OnPath& on_path) const {
  Survey survey;
  for (const Landmark* landmark : landmarks)
    survey.map.objects.push_back(map_object(*landmark, table_));
  for (std::size_t c = 0; c < flights_.size(); ++c) {
    if (flights_[c].keyframes.size() < 2) continue;  // an object map's: nobody knows its path
    for (const Keyframe& keyframe : flights_[c].keyframes)
      if (on_path(c, keyframe)) survey.path.push_back(keyframe.T_world_lidar.translation());
  }
  return survey;
}

Survey MultiRobotSlam::survey() const {
  std::vector<const Landmark*> all;
  for (const Landmark& landmark : landmarks_) all.push_back(&landmark);
  return survey(all, [](std::size_t, const Keyframe&) { return true; });
}

objects::ObjectMap MultiRobotSlam::map() const { return survey().map; }

Slam::MapWithCovariance MultiRobotSlam::map_with_covariance() const {
  MultiRobotSlam copy = *this;
  const std::vector<Landmark*> in_graph = pointers(copy.landmarks_);
  const std::vector<const Landmark*> wanted(in_graph.begin(), in_graph.end());
  const CovarianceReport report = graph_covariance(copy.chains(), in_graph, wanted, config_.graph);
  Slam::MapWithCovariance result{map(), report.marginal};
  for (std::size_t i = 0; i < wanted.size(); ++i) {
    result.map.objects[i].covariance = named_covariance(*wanted[i], report.covariances[i]);
  }
  return result;
}

objects::ObjectMap MultiRobotSlam::reported_map() const {
  objects::ObjectMap map = map_with_covariance().map;
  MultiRobotSlam copy = *this;
  const std::vector<Chain> all = copy.chains();
  for (std::size_t i = 0; i < landmarks_.size(); ++i) {
    const Landmark& landmark = landmarks_[i];
    Eigen::MatrixXd& covariance = map.objects[i].covariance;
    widen(covariance, landmark, all, config_);
    covariance.diagonal() += common_variances(landmark.model, config_.noise);
  }
  return map;
}

}  // namespace saker::slam
