#include "saker/multirobot/merge.h"

#include <algorithm>
#include <map>

#include "saker/slam/landmark_estimate.h"

namespace saker::multirobot {
namespace {

/// A history's measurement stands for many windows: its class may be as sure as they made it.
constexpr double kClassClamp = 1e-6;
constexpr std::size_t kMostMeasurements = 5000;  // of one entry: an object map makes one
constexpr double kSure = 1;                      // shape probability: its robot believed in it
constexpr double kToSettle = 0.3;                // of the time: the final solves of the whole graph
constexpr std::size_t kYoung = 10;  // observations of an object whose first may have been a part

bool is_of(const MergedFlight& flight, const slam::History& history) {
  return flight.robot == history.robot && flight.flight == history.flight;
}

bool finite(const slam::HistoryEntry& entry) {
  return entry.T_odom_lidar.matrix().allFinite() && entry.stamp >= 0;
}

/// Of what is new: in order, finite, and with motions that weigh something.
bool usable(const std::vector<slam::HistoryEntry>& entries, std::size_t from) {
  for (std::size_t k = from; k < entries.size(); ++k) {
    if (!finite(entries[k])) return false;
    if (k == 0) continue;
    const Matrix6d& motion = entries[k].motion_covariance;
    if (entries[k].stamp <= entries[k - 1].stamp || !motion.allFinite()) return false;
    if (motion.llt().info() != Eigen::Success) return false;
  }
  return true;
}

std::vector<slam::Landmark*> pointers(std::vector<slam::Landmark>& landmarks) {
  std::vector<slam::Landmark*> all;
  for (slam::Landmark& landmark : landmarks) all.push_back(&landmark);
  return all;
}

/// What is known of the pose of odometry's frame, of its first keyframe.
slam::PosePrior of_first_keyframe(const slam::PosePrior& T_world_odom, const SE3& T_odom_lidar) {
  const Matrix6d A = core::se3_adjoint(T_odom_lidar.inverse());
  return {T_world_odom.pose * T_odom_lidar, A * T_world_odom.covariance * A.transpose()};
}

bool seen_from(const slam::Landmark& landmark, int chain, int serial) {
  return std::ranges::any_of(landmark.observations, [&](const slam::Observation& o) {
    return o.chain == chain && o.keyframe >= serial;
  });
}

bool newer(const slam::Landmark& landmark, int chain, int serial) {
  return std::ranges::all_of(landmark.observations, [&](const slam::Observation& o) {
    return o.chain == chain && o.keyframe >= serial;
  });
}

}  // namespace

MultiRobotSlam::MultiRobotSlam(const MergeConfig& config, const slam::SlamConfig& slam,
                               const objects::ClassTable& table)
    : config_(core::checked(config, "multirobot")),
      slam_(core::checked(slam, "slam")),
      landmark_config_(slam.landmarks),
      table_(table) {
  landmark_config_.class_clamp = kClassClamp;
}

MergeReport MultiRobotSlam::add(const slam::History& history,
                                const std::optional<slam::PosePrior>& T_world_odom,
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
    const std::optional<slam::PosePrior> start = take_off(history, T_world_odom, budget, report);
    if (report.status != MergeStatus::merged) return report;
    flights_.push_back({history.robot, history.flight, start, {}});
  }
  for (std::size_t k = from; k < history.entries.size(); ++k) {
    append(flights_[chain], history.entries[k]);
    integrate(history.entries[k], static_cast<int>(chain), report);
    ++report.entries;
    if (report.entries % config_.track_every == 0) track(chain);
    if (report.entries % config_.loop_every == 0) close_loop(chain, report);
    if (budget.seconds_left() < kToSettle * given_s) break;
  }
  track(chain);
  close_loop(chain, report);
  settle(chain, budget, report);
  return report;
}

/// Of the first keyframe; none where this flight is to hold the frame.
std::optional<slam::PosePrior> MultiRobotSlam::take_off(
    const slam::History& history, const std::optional<slam::PosePrior>& T_world_odom,
    const core::Budget& budget, MergeReport& report) const {
  const SE3& T_odom_lidar = history.entries.front().T_odom_lidar;
  if (T_world_odom) return of_first_keyframe(*T_world_odom, T_odom_lidar);
  if (flights_.empty()) return std::nullopt;
  MultiRobotSlam alone(config_, slam_, table_);
  (void)alone.add(history, std::nullopt, budget);
  report.alignment = align(survey(), alone.survey(), config_.constellation);
  if (report.alignment.status == AlignmentStatus::accepted)
    return of_first_keyframe(report.alignment.T_a_b, T_odom_lidar);
  report.status = MergeStatus::not_aligned;
  return std::nullopt;
}

void MultiRobotSlam::append(MergedFlight& flight, const slam::HistoryEntry& entry) {
  slam::Keyframe keyframe{static_cast<int>(flight.keyframes.size()), entry.stamp,
                          entry.T_odom_lidar, entry.T_odom_lidar, entry.motion_covariance};
  if (!flight.keyframes.empty()) {
    const slam::Keyframe& before = flight.keyframes.back();
    keyframe.T_world_lidar =
        before.T_world_lidar * before.T_odom_lidar.inverse() * entry.T_odom_lidar;
  } else if (flight.prior) {
    keyframe.T_world_lidar = flight.prior->pose;
  }
  flight.keyframes.push_back(keyframe);
}

std::vector<slam::Candidate> MultiRobotSlam::candidates(const slam::HistoryEntry& entry, int chain,
                                                        bool moving, MergeReport& report) const {
  const SE3& T_world_lidar =
      flights_[static_cast<std::size_t>(chain)].keyframes.back().T_world_lidar;
  std::vector<slam::Candidate> all;
  for (const objects::Measurement& measurement : entry.measurements) {
    if (measurement.moving != moving) continue;
    const bool fits =
        measurement.class_probability.size() == static_cast<std::size_t>(table_.size()) &&
        slam::valid({measurement.model, measurement.covariance});
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

void MultiRobotSlam::integrate(const slam::HistoryEntry& entry, int chain, MergeReport& report) {
  take_back(candidates(entry, chain, true, report), chain);
  const std::vector<slam::Candidate> seen = candidates(entry, chain, false, report);
  const std::vector<int> landmark_of = associate(seen, landmarks_, table_, slam_.association);
  const std::vector<slam::Chain> all = chains();
  const int serial = flights_[static_cast<std::size_t>(chain)].keyframes.back().serial;
  for (std::size_t c = 0; c < seen.size(); ++c) {
    if (landmark_of[c] < 0) {
      ++report.created;
      landmarks_.push_back(new_landmark(next_id_++, seen[c], serial, landmark_config_));
      continue;
    }
    ++report.matched;
    slam::Landmark& landmark = landmarks_[static_cast<std::size_t>(landmark_of[c])];
    observe(landmark, seen[c], serial, landmark_config_);
    if (landmark.observations.size() <= kYoung) restart_if_better(landmark, all, slam_.graph);
  }
}

/// What a robot told of an object that turned out to move is void.
void MultiRobotSlam::take_back(const std::vector<slam::Candidate>& moving, int chain) {
  const std::vector<int> landmark_of = associate(moving, landmarks_, table_, slam_.association);
  for (const int l : landmark_of) {
    if (l < 0) continue;
    std::erase_if(landmarks_[static_cast<std::size_t>(l)].observations,
                  [&](const slam::Observation& o) { return o.chain == chain; });
  }
  std::erase_if(landmarks_, [](const slam::Landmark& l) { return l.observations.empty(); });
}

std::vector<slam::Chain> MultiRobotSlam::chains() {
  std::vector<slam::Chain> all;
  for (MergedFlight& flight : flights_) all.push_back({&flight.keyframes, flight.prior});
  return all;
}

void MultiRobotSlam::track(std::size_t chain) {
  const auto newest = static_cast<std::size_t>(config_.track_keyframes);
  std::vector<slam::Chain> all = chains();
  for (slam::Chain& each : all) each.free_from = each.keyframes->size();
  if (all[chain].free_from < 2) return;
  all[chain].free_from -= std::min(all[chain].free_from, newest);
  const auto free_from = static_cast<int>(all[chain].free_from);
  std::vector<slam::Landmark*> seen;
  for (slam::Landmark& landmark : landmarks_) {
    if (seen_from(landmark, static_cast<int>(chain), free_from)) seen.push_back(&landmark);
  }
  (void)solve_graph(all, seen, slam_.graph, core::Budget::iterations(config_.track_iterations));
}

/// Where there is one, poses and objects are put about where they belong, and the rest follows.
void MultiRobotSlam::close_loop(std::size_t chain, MergeReport& report) {
  std::vector<slam::Keyframe>& keyframes = flights_[chain].keyframes;
  const int since = static_cast<int>(keyframes.size()) - config_.loop_keyframes;
  if (since <= 0) return;
  std::vector<const slam::Landmark*> recent, older;
  for (const slam::Landmark& landmark : landmarks_) {
    if (!seen_from(landmark, static_cast<int>(chain), since)) older.push_back(&landmark);
    if (newer(landmark, static_cast<int>(chain), since)) recent.push_back(&landmark);
  }
  const auto is_recent = [&](std::size_t c, const slam::Keyframe& k) {
    return c == chain && k.serial >= since;
  };
  const AlignmentBounds bounds{config_.loop_shift_m, config_.loop_turn_deg};
  const Alignment loop =
      align(survey(older, [&](std::size_t c, const slam::Keyframe& k) { return !is_recent(c, k); }),
            survey(recent, is_recent), config_.constellation, bounds);
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
  (void)solve_graph(chains(), pointers(landmarks_), whole_graph(config_.first_scale),
                    core::Budget::iterations(config_.iterations));
}

/// One flight and what it saw, the other flights held.
slam::SolveReport MultiRobotSlam::solve_flight(std::size_t chain, double scale,
                                               const core::Budget& budget) {
  std::vector<slam::Chain> all = chains();
  for (std::size_t c = 0; c < all.size(); ++c)
    if (c != chain) all[c].free_from = all[c].keyframes->size();
  std::vector<slam::Landmark*> seen;
  for (slam::Landmark& landmark : landmarks_)
    if (seen_from(landmark, static_cast<int>(chain), 0)) seen.push_back(&landmark);
  return solve_graph(all, seen, whole_graph(scale), budget);
}

/// Recent objects follow the correction; those that are old ones become one with them.
void MultiRobotSlam::join(const Alignment& loop) {
  for (const auto& [older, recent] : loop.matches) {
    const auto a = std::ranges::find(landmarks_, older, &slam::Landmark::id);
    const auto b = std::ranges::find(landmarks_, recent, &slam::Landmark::id);
    b->model = objects::transformed(loop.T_a_b.pose, b->model);
    absorb(*a, *b);
    landmarks_.erase(b);
  }
}

slam::GraphConfig MultiRobotSlam::whole_graph(double scale) const {
  slam::GraphConfig graph = slam_.graph;
  graph.iterations = config_.iterations;
  graph.trust_radius = config_.trust_radius;
  graph.robust_scale *= scale;
  return graph;
}

/// The others have settled: while the kernel is wide only this flight moves. What it took for new
/// because it had drifted lies on what it is by then.
slam::SolveReport MultiRobotSlam::solve_narrowing(std::size_t chain, const core::Budget& budget) {
  for (double scale = config_.first_scale; scale > 1; scale /= 2)
    (void)solve_flight(chain, scale, budget);
  (void)merge_duplicates(landmarks_, slam_.duplicates, landmark_config_);
  return solve_graph(chains(), pointers(landmarks_), whole_graph(1), budget);
}

void MultiRobotSlam::settle(std::size_t chain, const core::Budget& budget, MergeReport& report) {
  report.solve = solve_narrowing(chain, budget);
  const int joined = merge_duplicates(landmarks_, slam_.duplicates, landmark_config_);
  const int apart = split();
  // Two objects cannot stand on one ground: there a flight mismeasured the one that it saw.
  const int rejoined = merge_duplicates(landmarks_, slam_.duplicates, landmark_config_);
  report.split = apart - rejoined;
  if (joined + apart > 0)
    report.solve = solve_graph(chains(), pointers(landmarks_), whole_graph(1), budget);
}

/// Where one flight's measurements of an object lie far from those of another flight they are of
/// another object.
int MultiRobotSlam::split() {
  const std::vector<slam::Chain> all = chains();
  std::vector<slam::Landmark> apart;
  for (slam::Landmark& landmark : landmarks_) {
    for (const int chain : disagreeing(landmark, all)) {
      slam::Landmark other = landmark;
      other.id = next_id_++;
      std::erase_if(other.observations,
                    [&](const slam::Observation& o) { return o.chain != chain; });
      std::erase_if(landmark.observations,
                    [&](const slam::Observation& o) { return o.chain == chain; });
      (void)refine(other, all, slam_.graph);
      apart.push_back(std::move(other));
    }
  }
  std::ranges::move(apart, std::back_inserter(landmarks_));
  return static_cast<int>(apart.size());
}

std::vector<int> MultiRobotSlam::disagreeing(const slam::Landmark& landmark,
                                             slam::Chains chains) const {
  struct Sum {
    double weight = 0, count = 0;
  };
  std::map<int, Sum> of_chain;
  const std::vector<double> weights = robust_weights(landmark, chains, slam_.graph);
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
    if (mean < config_.disagreement && mean < config_.disagreement * best) apart.push_back(chain);
  }
  return apart;
}

Survey MultiRobotSlam::survey(const std::vector<const slam::Landmark*>& landmarks,
                              const OnPath& on_path) const {
  Survey survey;
  for (const slam::Landmark* landmark : landmarks)
    survey.map.objects.push_back(map_object(*landmark, table_));
  for (std::size_t c = 0; c < flights_.size(); ++c) {
    if (flights_[c].keyframes.size() < 2) continue;  // an object map's: nobody knows its path
    for (const slam::Keyframe& keyframe : flights_[c].keyframes)
      if (on_path(c, keyframe)) survey.path.push_back(keyframe.T_world_lidar.translation());
  }
  return survey;
}

Survey MultiRobotSlam::survey() const {
  std::vector<const slam::Landmark*> all;
  for (const slam::Landmark& landmark : landmarks_) all.push_back(&landmark);
  return survey(all, [](std::size_t, const slam::Keyframe&) { return true; });
}

objects::ObjectMap MultiRobotSlam::map() const { return survey().map; }

slam::Slam::MapWithCovariance MultiRobotSlam::map_with_covariance() const {
  MultiRobotSlam copy = *this;
  const std::vector<slam::Landmark*> in_graph = pointers(copy.landmarks_);
  const std::vector<const slam::Landmark*> wanted(in_graph.begin(), in_graph.end());
  const slam::CovarianceReport report =
      graph_covariance(copy.chains(), in_graph, wanted, slam_.graph);
  slam::Slam::MapWithCovariance result{map(), report.marginal};
  for (std::size_t i = 0; i < wanted.size(); ++i) {
    result.map.objects[i].covariance = named_covariance(*wanted[i], report.covariances[i]);
  }
  return result;
}

objects::ObjectMap MultiRobotSlam::reported_map() const {
  objects::ObjectMap map = map_with_covariance().map;
  MultiRobotSlam copy = *this;
  const std::vector<slam::Chain> all = copy.chains();
  for (std::size_t i = 0; i < landmarks_.size(); ++i) {
    const slam::Landmark& landmark = landmarks_[i];
    Eigen::MatrixXd& covariance = map.objects[i].covariance;
    widen(covariance, landmark, all, slam_);
    covariance.diagonal() += common_variances(landmark.model, slam_.noise);
  }
  return map;
}

}  // namespace saker::multirobot
