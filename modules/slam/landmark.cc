#include "saker/slam/landmark.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>
#include <tuple>
#include <utility>

#include "saker/objects/stated_length.h"
#include "saker/slam/landmark_evidence.h"

namespace saker::slam {
namespace {

using objects::Cuboid;

constexpr std::size_t kRecentWindows = 10;  // 5 s: half a metre a second shows
constexpr double kMostFront = 10;           // the same for front and back

void fuse_class(Landmark& landmark, const std::vector<double>& log_probability) {
  auto& fused = landmark.class_log;
  if (fused.empty()) fused.assign(log_probability.size(), 0);
  const std::size_t count = std::min(fused.size(), log_probability.size());
  for (std::size_t i = 0; i < count; ++i) fused[i] += log_probability[i];
  const double highest = *std::max_element(fused.begin(), fused.end());
  for (double& value : fused) value -= highest;
}

double logit(double probability) { return std::log(probability / (1 - probability)); }

/// How much one window speaks for an object against clutter: the share of its points that have the
/// shape, with the Beta prior of a window that speaks for neither. What states no points has many.
double evidence(double shape_probability, int points, const LandmarkConfig& config) {
  const double neutral = config.clutter_probability;
  const double weight = points > 0 ? points / (points + config.clutter_points) : 1;
  const double p = neutral + weight * (shape_probability - neutral);
  return logit(std::clamp(p, config.class_clamp, 1 - config.class_clamp)) - logit(neutral);
}

void fuse_front(Landmark& landmark, const Eigen::Vector2d& front) {
  landmark.front = (landmark.front + front).cwiseMax(-kMostFront).cwiseMin(kMostFront);
}

Gaussian turned_by(const Gaussian& measured, int quarters) {
  return is_cuboid(measured.model) ? turned(measured, quarters) : measured;
}

void track(Landmark& landmark, const Model& in_world, const Candidate& candidate,
           const LandmarkConfig& config) {
  const auto* cuboid = std::get_if<Cuboid>(&in_world);
  if (cuboid == nullptr) return;
  auto& recent = landmark.recent;
  if (to_seconds(candidate.measurement->stamp - landmark.last_stamp) > config.track_s)
    recent.clear();
  if (recent.size() >= kRecentWindows) recent.erase(recent.begin());
  recent.push_back({cuboid->pose.translation(), cuboid->size.head<2>(), place_sd(candidate)});
}

void count(Landmark& landmark, const Candidate& candidate) {
  ++landmark.seen;
  landmark.last_stamp = candidate.measurement->stamp;
  landmark.nearest = std::min(landmark.nearest, candidate.distance);
  landmark.farthest = std::max(landmark.farthest, candidate.distance);
}

/// The height of a cylinder is that of the part that was seen: the most that was seen of it.
void raise(Model& model, const Model& measured) {
  if (auto* cylinder = std::get_if<objects::Cylinder>(&model)) {
    cylinder->height = std::max(cylinder->height, std::get<objects::Cylinder>(measured).height);
  }
}

objects::Shape shape_of(const Model& model) {
  return is_cuboid(model) ? objects::Shape::cuboid : objects::Shape::cylinder;
}

/// What a window adds to what is known of the ends of what it takes for the length. What it says of
/// that as a whole is shared out between them as its covariance does.
void see_ends(Landmark& landmark, const Gaussian& measured, double length_sd) {
  const int axis = longer_axis(std::get<Cuboid>(measured.model));
  const Eigen::Vector2d sds = end_variances(measured.covariance, axis).cwiseSqrt();
  landmark.ends[axis].see(length_sd / sds.norm() * sds);
}

/// What another landmark knows of the ends.
void see_ends_of(Landmark& landmark, const Landmark& other, int turn) {
  for (int others = 0; others < 2; ++others) {
    const Eigen::Vector2d along = turned(Eigen::Vector2d(Eigen::Vector2d::Unit(others)), turn);
    const int axis = std::abs(along.x()) > 0.5 ? 0 : 1;
    for (const Eigen::Vector2d& sds : {other.ends[others].best, other.ends[others].next}) {
      landmark.ends[axis].see(along[axis] > 0 ? sds : Eigen::Vector2d(sds.reverse()));
    }
  }
}

/// The axis of a cuboid's length by the views whose width is no guess: windows from one cell count
/// once, for they make the same mistake together. A draw: −1.
int length_axis(const Landmark& landmark, const LengthAxisConfig& config) {
  if (!is_cuboid(landmark.model)) return -1;
  std::array<int, 2> views{};
  std::set<std::pair<int, int>> counted;  // cell, axis
  for (const Observation& o : landmark.observations) {
    const auto& cuboid = std::get<Cuboid>(o.measured.model);
    const int axis = longer_axis(cuboid);
    const double width_sd = std::sqrt(o.measured.covariance(7 - axis, 7 - axis));
    if (elongation(cuboid) < config.elongation || width_sd > config.most_width_sd_m) continue;
    if (o.cell < 0) {
      views[axis] += o.windows;
    } else if (counted.emplace(o.cell, axis).second) {
      ++views[axis];
    }
  }
  if (views[0] == views[1]) return -1;
  return views[0] > views[1] ? 0 : 1;
}

/// Whether a window took a side of the vehicle for its length: where its box is nearly square, by
/// what it knows less well, as nobody saw how long it is.
bool contradicts(const Observation& observation, int length_axis, double least_elongation) {
  if (length_axis < 0) return false;
  const auto& cuboid = std::get<Cuboid>(observation.measured.model);
  if (elongation(cuboid) >= least_elongation) return longer_axis(cuboid) != length_axis;
  const Eigen::MatrixXd& covariance = observation.measured.covariance;
  return covariance(6 + length_axis, 6 + length_axis) <
         covariance(7 - length_axis, 7 - length_axis);
}

/// From the least of the low values to the greatest of the high ones, `false_ones` left out of
/// each.
double span(std::vector<double> low, std::vector<double> high, std::size_t false_ones) {
  const std::size_t at = std::min(false_ones, low.size() - 1);
  std::ranges::sort(low);
  std::ranges::sort(high, std::ranges::greater());
  return high[at] - low[at];
}

}  // namespace

double place_sd(const Candidate& candidate) {
  return std::sqrt(candidate.in_keyframe.covariance.block<2, 2>(3, 3).trace());
}

void SeenEnds::see(const Eigen::Vector2d& sds) {
  next = next.cwiseMin(best.cwiseMax(sds));
  best = best.cwiseMin(sds);
}

std::vector<double> clamped_log(const std::vector<double>& probability, double least) {
  std::vector<double> logs;
  for (const double p : probability)
    logs.push_back(std::log(std::isfinite(p) ? std::clamp(p, least, 1 - least) : least));
  return logs;
}

void join(Observation& a, const Observation& b) {
  const int windows = a.windows + b.windows;
  if (a.cell < 0) {
    a.measured = fused(a.measured, b.measured);
  } else {
    a.measured = fused({a.measured.model, a.measured.covariance / a.windows},
                       {b.measured.model, b.measured.covariance / b.windows});
    a.measured.covariance *= windows;
  }
  a.windows = windows;
}

int turn_between(const Model& model, const Model& reference) {
  if (!is_cuboid(model)) return 0;
  return nearest_turn(std::get<Cuboid>(model), std::get<Cuboid>(reference));
}

Landmark new_landmark(int id, const Candidate& candidate, int keyframe,
                      const LandmarkConfig& config) {
  Landmark landmark;
  landmark.id = id;
  landmark.model = candidate.in_world;
  landmark.first_stamp = candidate.measurement->stamp;
  observe(landmark, candidate, keyframe, config);
  return landmark;
}

void observe(Landmark& landmark, const Candidate& candidate, int keyframe,
             const LandmarkConfig& config) {
  const int turn = turn_between(candidate.in_world, landmark.model);
  const double front = std::isfinite(candidate.measurement->front_log_odds)
                           ? candidate.measurement->front_log_odds
                           : 0;
  fuse_front(landmark, turned(Eigen::Vector2d(front, 0), turn));
  fuse_class(landmark, clamped_log(candidate.measurement->class_probability, config.class_clamp));
  landmark.log_odds += evidence(candidate.shape_probability, candidate.measurement->points, config);
  const Gaussian in_keyframe = turned_by(candidate.in_keyframe, turn);
  remember(landmark, {keyframe, in_keyframe, candidate.measurement->view_cell, 1, candidate.chain});
  if (is_cuboid(landmark.model)) {
    see_ends(landmark, in_keyframe, length_sd(*candidate.measurement));
  }
  raise(landmark.model, candidate.in_world);
  Model in_world = candidate.in_world;
  if (is_cuboid(in_world)) in_world = turned(std::get<Cuboid>(in_world), turn);
  track(landmark, in_world, candidate, config);
  count(landmark, candidate);
}

void follow(Landmark& landmark, const Candidate& candidate, int keyframe,
            const LandmarkConfig& config) {
  const double step = (objects::place(candidate.in_world) - objects::place(landmark.model)).norm();
  const int still = step <= config.still_m ? landmark.still + 1 : 0;
  landmark = new_landmark(landmark.id, candidate, keyframe, config);
  landmark.still = still;
  landmark.moving = still < config.still_windows;
}

void absorb(Landmark& landmark, const Landmark& other) {
  const int turn = turn_between(other.model, landmark.model);
  for (Observation observation : other.observations) {
    observation.measured = turned_by(observation.measured, turn);
    remember(landmark, observation);
  }
  fuse_front(landmark, turned(other.front, turn));
  fuse_class(landmark, other.class_log);
  landmark.log_odds += other.log_odds;
  raise(landmark.model, other.model);
  // A window that measured one of them did not miss what they are together.
  landmark.missed = std::max({0, landmark.missed - other.seen, other.missed - landmark.seen});
  landmark.seen += other.seen;
  landmark.seen_moving += other.seen_moving;
  landmark.moving = landmark.moving || other.moving;
  landmark.first_stamp = std::min(landmark.first_stamp, other.first_stamp);
  landmark.last_stamp = std::max(landmark.last_stamp, other.last_stamp);
  if (is_cuboid(landmark.model)) see_ends_of(landmark, other, turn);
  landmark.nearest = std::min(landmark.nearest, other.nearest);
  landmark.farthest = std::max(landmark.farthest, other.farthest);
}

void remember(Landmark& landmark, const Observation& observation) {
  const auto key = [](const Observation& o) { return std::tuple(o.chain, o.keyframe, o.cell); };
  auto& all = landmark.observations;
  const auto at = std::ranges::lower_bound(all, key(observation), {}, key);
  if (at != all.end() && key(*at) == key(observation)) {
    join(*at, observation);
  } else {
    all.insert(at, observation);
  }
}

std::vector<double> observation_weights(const Landmark& landmark, const LengthAxisConfig& config) {
  const int axis = length_axis(landmark, config);
  const auto left_out = [&](const Observation& o) {
    return contradicts(o, axis, config.elongation);
  };
  std::map<int, int> windows;
  for (const Observation& o : landmark.observations) {
    if (!left_out(o)) windows[o.cell] += o.windows;
  }
  std::vector<double> weights;
  for (const Observation& o : landmark.observations) {
    const double share = o.cell < 0 ? 1 : static_cast<double>(o.windows) / windows[o.cell];
    weights.push_back(left_out(o) ? 0 : share);
  }
  return weights;
}

std::vector<double> normalised(const std::vector<double>& log_probability) {
  std::vector<double> probability;
  double sum = 0;
  for (const double value : log_probability) sum += probability.emplace_back(std::exp(value));
  for (double& p : probability) p /= sum;
  return probability;
}

std::vector<double> class_probability(const Landmark& landmark) {
  return normalised(landmark.class_log);
}

objects::ClassId class_of(const Landmark& landmark, const objects::ClassTable& table) {
  const objects::Shape shape = shape_of(landmark.model);
  int best = 0;
  for (int id = 0; id < std::min<int>(table.size(), static_cast<int>(landmark.class_log.size()));
       ++id) {
    if (table[static_cast<objects::ClassId>(id)].shape != shape) continue;
    const auto log = [&](int i) { return landmark.class_log[static_cast<std::size_t>(i)]; };
    if (best == 0 || log(id) > log(best)) best = id;
  }
  return static_cast<objects::ClassId>(best);
}

bool stands(const Landmark& landmark, const LandmarkConfig& config) {
  if (is_mobile(landmark) || landmark.seen < config.confirm_observations) return false;
  if (to_seconds(landmark.last_stamp - landmark.first_stamp) < config.confirm_span_s) return false;
  return log_odds(landmark, config) >= config.least_log_odds;
}

const SeenEnds& seen_ends(const Landmark& landmark) {
  return landmark.ends[longer_axis(std::get<Cuboid>(landmark.model))];
}

bool believed(const Landmark& landmark, const LandmarkConfig& config) {
  const bool ends_known =
      !is_cuboid(landmark.model) || seen_ends(landmark).next.norm() <= config.most_length_sd_m;
  return ends_known && stands(landmark, config);
}

bool moves(const Landmark& landmark, double footprint_m, const LandmarkConfig& config) {
  if (landmark.recent.size() < 2) return false;
  const SE3 T_cuboid_world = std::get<Cuboid>(landmark.model).pose.inverse();
  std::array<std::vector<double>, 2> low, high;
  double longest = footprint_m;
  for (const Footprint& footprint : landmark.recent) {
    const Eigen::Vector3d centre = T_cuboid_world * footprint.centre;
    for (const int axis : {0, 1}) {
      const double half = 0.5 * footprint.size[axis] - config.sure_sd * footprint.sd;
      low[axis].push_back(centre[axis] - half);
      high[axis].push_back(centre[axis] + half);
    }
    longest = std::max(longest, footprint.size.maxCoeff());
  }
  const std::size_t false_ones = landmark.seen > config.still_windows ? 1 : 0;
  const double covered =
      std::max(span(low[0], high[0], false_ones), span(low[1], high[1], false_ones));
  return covered > longest + config.moving_distance_m;
}

bool comes_back(const Landmark& landmark, const LandmarkConfig& config) {
  const std::vector<Footprint>& recent = landmark.recent;
  if (recent.empty()) return false;
  const auto away = [&](const Footprint& footprint) {
    return (footprint.centre - recent.back().centre).head<2>().norm();
  };
  const auto before = std::ranges::find_if(
      recent, [&](const Footprint& f) { return away(f) <= config.moving_distance_m; });
  return std::any_of(before, recent.end(), [&](const Footprint& f) {
    return away(f) > config.moving_distance_m + config.sure_sd * (f.sd + recent.back().sd);
  });
}

bool lies_across_two(const Landmark& landmark, const LandmarkConfig& config) {
  const int windows = landmark.seen_as_one + landmark.seen_as_two;
  return landmark.seen_as_two >= config.two_windows &&
         landmark.seen_as_two >= config.two_share * windows;
}

int naming_turn(const Landmark& landmark) {
  if (!is_cuboid(landmark.model)) return 0;
  const auto& cuboid = std::get<Cuboid>(landmark.model);
  if (longer_axis(cuboid) == 0) return landmark.front.x() >= 0 ? 0 : 2;
  return landmark.front.y() >= 0 ? 1 : 3;
}

objects::MapObject map_object(const Landmark& landmark, const objects::ClassTable& table) {
  objects::MapObject object;
  object.id = landmark.id;
  object.class_id = class_of(landmark, table);
  object.class_probability = class_probability(landmark);
  object.observations = landmark.seen;
  object.model = landmark.model;
  if (is_cuboid(landmark.model)) {
    object.model = turned(std::get<Cuboid>(landmark.model), naming_turn(landmark));
  }
  return object;
}

Eigen::MatrixXd named_covariance(const Landmark& landmark, const Eigen::MatrixXd& covariance) {
  if (!is_cuboid(landmark.model) || covariance.size() == 0) return covariance;
  return turned(Gaussian{landmark.model, covariance}, naming_turn(landmark)).covariance;
}

Eigen::Vector2d named_ends(const Landmark& landmark) {
  if (!is_cuboid(landmark.model)) return SeenEnds().next;
  const int axis = longer_axis(std::get<Cuboid>(landmark.model));
  const Eigen::Vector2d named =
      turned(Eigen::Vector2d(Eigen::Vector2d::Unit(axis)), naming_turn(landmark));
  const Eigen::Vector2d& next = seen_ends(landmark).next;
  return named.x() > 0 ? next : next.reverse();
}

}  // namespace saker::slam
