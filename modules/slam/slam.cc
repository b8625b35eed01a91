#include "saker/slam/slam.h"

#include <algorithm>

#include "saker/objects/stated_length.h"
#include "saker/slam/landmark_estimate.h"
#include "saker/slam/landmark_evidence.h"
#include "saker/slam/sight.h"

namespace saker::slam {
namespace {

constexpr std::size_t kMostMeasurements = 500;  // of one window: more is a fault of what made them

double shape_probability(const objects::Measurement& measurement,
                         const objects::ClassTable& table) {
  const objects::Shape shape =
      is_cuboid(measurement.model) ? objects::Shape::cuboid : objects::Shape::cylinder;
  double sum = 0;
  for (int id = 0; id < table.size(); ++id) {
    if (table.classes[id].shape == shape) sum += measurement.class_probability[id];
  }
  return sum;
}

bool fits(const objects::Measurement& measurement, const objects::ClassTable& table) {
  return measurement.class_probability.size() == static_cast<std::size_t>(table.size()) &&
         valid({measurement.model, measurement.covariance});
}

/// Landmarks with a place in the graph.
std::vector<Landmark*> believed_ones(std::vector<Landmark>& landmarks,
                                     const LandmarkConfig& config) {
  std::vector<Landmark*> all;
  for (Landmark& landmark : landmarks) {
    if (believed(landmark, config)) all.push_back(&landmark);
  }
  return all;
}

/// How many windows count for one.
MeasurementNoiseConfig shared_noise(const SlamConfig& config) {
  MeasurementNoiseConfig noise = config.noise;
  if (config.measurement_noise == NoiseSource::fitted) {  // cells count once
    noise.shared_radius = noise.shared_radius_cells;
    noise.shared_place = noise.shared_length = noise.shared_width = noise.shared_root = 1;
  }
  return noise;
}

/// No end of an incomplete object is known better than the window that saw it best: what others say
/// of a hidden one is the size of its class, which is the same in all of them. Empty where none saw
/// any.
void limit_to_best(Eigen::MatrixXd& covariance, const Landmark& landmark) {
  if (!is_cuboid(landmark.model) || covariance.size() == 0) return;
  const Eigen::Vector2d& best = seen_ends(landmark).best;
  if (!best.allFinite()) {
    covariance.resize(0, 0);
    return;
  }
  raise_end_variances(covariance, longer_axis(std::get<objects::Cuboid>(landmark.model)),
                      best.cwiseAbs2());
}

/// By its name, as far as its cells agree, as wide as what windows share asks for, and an end that
/// none looked at no better known than what they share of it; its width no worse than its class's,
/// where cells count. Empty where nothing was measured.
Eigen::MatrixXd widened(const Landmark& landmark, const GivenPoses& given, const SlamConfig& config,
                        const objects::ClassTable& table) {
  if (given.covariance.size() == 0) return {};
  const Eigen::MatrixXd scattered =
      given.scatter.asDiagonal() * given.covariance * given.scatter.asDiagonal();
  Eigen::MatrixXd named =
      widened(landmark.model, named_covariance(landmark, scattered), shared_noise(config));
  const Eigen::Vector2d ends = named_ends(landmark);
  if (config.noise.share_ends && is_cuboid(landmark.model) && ends.allFinite()) {
    const Eigen::Array2d shares = (config.noise.shared_end_per_m * ends.array()).min(1);
    raise_end_variances(named, 0, (shares * ends.array()).square());
  }
  if (is_cuboid(landmark.model) && config.measurement_noise == NoiseSource::fitted) {
    return with_class_width(named, table[class_of(landmark, table)].width_sd_m);
  }
  return named;
}

}  // namespace

void widen(Eigen::MatrixXd& covariance, const Landmark& landmark, Chains chains,
           const SlamConfig& config, const objects::ClassTable& table) {
  const GivenPoses given = given_poses(landmark, chains, config.graph);
  if (given.covariance.rows() != covariance.rows()) return;  // nothing was measured
  covariance +=
      widened(landmark, given, config, table) - named_covariance(landmark, given.covariance);
}

Slam::Slam(const SlamConfig& config, const objects::ClassTable& table)
    : config_(core::checked(config, "slam")),
      table_(table),
      trajectory_(config.keyframes),
      ground_(config.ground),
      recorder_(config.history) {}

SlamUpdate Slam::update(const SlamInput& input, const core::Budget& budget) {
  SlamUpdate report;
  if (last_stamp_ && input.stamp <= *last_stamp_) report.status = SlamStatus::old_input;
  if (!input.T_odom_lidar.matrix().allFinite()) report.status = SlamStatus::invalid_input;
  if (report.status != SlamStatus::updated) return report;
  last_stamp_ = input.stamp;
  report.keyframe_added =
      trajectory_.advance(input.stamp, input.T_odom_lidar, input.odometry_covariance);
  if (report.keyframe_added) {
    record();
    retire();
  }
  const std::vector<Candidate> candidates = accepted(input.detections, report);
  integrate(candidates, report);
  review(report);
  ground_.add(input.detections.ground, trajectory_);
  optimise(budget, report);
  report.T_world_lidar = trajectory_.T_world_lidar();
  return report;
}

/// The trajectory in the graph: what is too old to move is held.
Chain Slam::chain() {
  const auto movable = static_cast<std::size_t>(config_.graph.movable_keyframes);
  const std::size_t size = trajectory_.keyframes().size();
  return {&trajectory_.keyframes(), std::nullopt, size > movable + 1 ? size - movable : 0};
}

void Slam::record() {
  const std::vector<Keyframe>& all = trajectory_.keyframes();
  if (all.size() < 2) return;
  recorder_.close(all[all.size() - 2], all.back(), landmarks_, config_.landmarks);
}

/// Keyframes that no longer move, or go, hand what was measured from them on to the first one.
void Slam::retire() {
  const std::vector<Keyframe>& keyframes = trajectory_.keyframes();
  const auto hand_over_from = [&](const Keyframe& keyframe) {
    for (Landmark& landmark : landmarks_) {
      hand_over(landmark, keyframe, keyframes.front(), config_.graph);
    }
  };
  if (const std::optional<Keyframe>& retired = trajectory_.retired()) {
    ground_.retire(*retired);
    hand_over_from(*retired);
  }
  if (const std::size_t held = chain().free_from; held > 0) hand_over_from(keyframes[held - 1]);
}

std::vector<Candidate> Slam::accepted(const objects::Detections& detections,
                                      SlamUpdate& report) const {
  std::vector<Candidate> candidates;
  for (const objects::Measurement& measurement : detections.measurements) {
    if (candidates.size() >= kMostMeasurements || !fits(measurement, table_)) {
      ++report.refused;
      continue;
    }
    const Gaussian in_lidar = with_common_errors({measurement.model, measurement.covariance},
                                                 config_.noise, measurement.view_cell >= 0);
    Candidate candidate;
    candidate.measurement = &measurement;
    candidate.shape_probability = shape_probability(measurement, table_);
    candidate.in_keyframe =
        transformed(trajectory_.T_keyframe_lidar(), trajectory_.motion_covariance(), in_lidar);
    candidate.in_world = objects::transformed(trajectory_.T_world_lidar(), measurement.model);
    candidate.distance = objects::place(measurement.model).norm();
    candidates.push_back(std::move(candidate));
  }
  return candidates;
}

void Slam::integrate(const std::vector<Candidate>& candidates, SlamUpdate& report) {
  count_on_ground(landmarks_, candidates, config_.duplicates);
  const std::vector<int> landmark_of =
      associate(candidates, landmarks_, table_, config_.association);
  if (!candidates.empty()) expect(landmark_of);
  for (std::size_t c = 0; c < candidates.size(); ++c) {
    const Candidate& candidate = candidates[c];
    const auto known = static_cast<std::size_t>(std::max(landmark_of[c], 0));
    if (candidate.measurement->moving) {
      ++report.moving;
      if (landmark_of[c] >= 0) ++landmarks_[known].seen_moving;
    } else if (landmark_of[c] >= 0) {
      ++report.matched;
      take(landmarks_[known], candidate);
    } else {
      ++report.created;
      landmarks_.push_back(
          new_landmark(next_id_++, candidate, trajectory_.newest().serial, config_.landmarks));
      recorder_.measured(landmarks_.back(), candidate, config_.landmarks);
    }
  }
}

void Slam::take(Landmark& landmark, const Candidate& candidate) {
  const int keyframe = trajectory_.newest().serial;
  if (landmark.moving) {
    follow(landmark, candidate, keyframe, config_.landmarks);
  } else {
    observe(landmark, candidate, keyframe, config_.landmarks);
    recorder_.measured(landmark, candidate, config_.landmarks);
    const Chain own = chain();
    restart_if_better(landmark, {&own, 1}, config_.graph);
  }
}

void Slam::expect(const std::vector<int>& measured) {
  const Eigen::Vector3d here = trajectory_.T_world_lidar().translation();
  const std::vector<objects::Cuboid> cuboids = believed_cuboids(landmarks_, config_.landmarks);
  for (std::size_t l = 0; l < landmarks_.size(); ++l) {
    if (std::find(measured.begin(), measured.end(), static_cast<int>(l)) != measured.end())
      continue;
    if (in_view(landmarks_[l], here, cuboids, config_.landmarks)) ++landmarks_[l].missed;
  }
}

bool Slam::wanders(const Landmark& landmark) const {
  return moves(landmark, table_[class_of(landmark, table_)].footprint_m, config_.landmarks);
}

void Slam::review(SlamUpdate& report) {
  report.merged = merge_duplicates(landmarks_, config_.duplicates, config_.landmarks);
  const auto of_two = [this](const Landmark& landmark) {
    return !landmark.moving && (lies_across_two(landmark, config_.landmarks) ||
                                (wanders(landmark) && comes_back(landmark, config_.landmarks)));
  };
  report.removed += static_cast<int>(std::erase_if(landmarks_, of_two));
  for (Landmark& landmark : landmarks_) {
    if (landmark.moving || !wanders(landmark)) continue;
    landmark.moving = true;
    ++report.removed;
  }
  const auto gone = [this](const Landmark& landmark) {
    const double unseen = to_seconds(*last_stamp_ - landmark.last_stamp);
    return landmark.moving ? unseen > config_.landmarks.track_s
                           : landmark.seen_moving > std::max(2, landmark.seen);
  };
  std::erase_if(landmarks_, gone);
  while (static_cast<int>(landmarks_.size()) > config_.landmarks.most) {
    landmarks_.erase(
        std::min_element(landmarks_.begin(), landmarks_.end(),
                         [](const Landmark& a, const Landmark& b) { return a.seen < b.seen; }));
    ++report.removed;
  }
}

void Slam::optimise(const core::Budget& budget, SlamUpdate& report) {
  const Chain own = chain();
  for (Landmark& landmark : landmarks_) {
    if (!landmark.moving && !believed(landmark, config_.landmarks))
      refine(landmark, {&own, 1}, config_.graph);
  }
  const std::vector<Landmark*> in_graph = believed_ones(landmarks_, config_.landmarks);
  report.confirmed = static_cast<int>(in_graph.size());
  report.solve = solve_graph({&own, 1}, in_graph, config_.graph, budget);
}

objects::ObjectMap Slam::map() const {
  return map_with([](const Landmark&) { return Eigen::MatrixXd(); });
}

objects::ObjectMap Slam::map_given_poses() const {
  std::vector<Keyframe> poses = trajectory_.keyframes();
  const Chain own{&poses};
  return map_with([&](const Landmark& landmark) {
    return widened(landmark, given_poses(landmark, {&own, 1}, config_.graph), config_, table_);
  });
}

objects::ObjectMap Slam::map_with(
    const std::function<Eigen::MatrixXd(const Landmark&)>& covariance) const {
  objects::ObjectMap map;
  for (const Landmark& landmark : landmarks_) {
    if (!stands(landmark, config_.landmarks)) continue;
    objects::MapObject object = map_object(landmark, table_);
    object.covariance = covariance(landmark);
    const bool complete = believed(landmark, config_.landmarks);
    (complete ? map.objects : map.incomplete).push_back(std::move(object));
  }
  map.ground = ground_.planes(trajectory_);
  return map;
}

std::vector<objects::MapObject> Slam::tentative() const {
  std::vector<objects::MapObject> objects;
  for (const Landmark& landmark : landmarks_) {
    if (is_mobile(landmark) || log_odds(landmark, config_.landmarks) <= 0) continue;
    if (believed(landmark, config_.landmarks)) continue;
    objects.push_back(map_object(landmark, table_));
    objects.back().observations = landmark.seen;
  }
  return objects;
}

Slam::MapWithCovariance Slam::map_with_covariance() const {
  MapWithCovariance result{map(), true};
  std::vector<int> ids;
  for (const objects::MapObject& object : result.map.objects) ids.push_back(object.id);
  CovarianceReport report = covariance(ids);
  result.marginal = report.marginal;
  for (std::size_t i = 0; i < ids.size(); ++i) {
    result.map.objects[i].covariance = std::move(report.covariances[i]);
  }
  return result;
}

objects::ObjectMap Slam::reported_map() const {
  objects::ObjectMap map = map_with_covariance().map;
  std::vector<Keyframe> poses = trajectory_.keyframes();
  const Chain own{&poses};
  const auto landmark_of = [this](const objects::MapObject& object) -> const Landmark& {
    return *std::ranges::find(landmarks_, object.id, &Landmark::id);
  };
  for (objects::MapObject& object : map.objects) {
    widen(object.covariance, landmark_of(object), {&own, 1}, config_, table_);
  }
  for (objects::MapObject& object : map.incomplete) {
    const Landmark& landmark = landmark_of(object);
    GivenPoses given = given_poses(landmark, {&own, 1}, config_.graph);
    limit_to_best(given.covariance, landmark);
    object.covariance = widened(landmark, given, config_, table_);
  }
  return map;
}

CovarianceReport Slam::covariance(std::span<const int> ids) const {
  std::vector<Keyframe> poses = trajectory_.keyframes();
  const Chain own{&poses};
  std::vector<Landmark> copies = landmarks_;
  const std::vector<Landmark*> in_graph = believed_ones(copies, config_.landmarks);
  std::vector<const Landmark*> wanted;
  for (const Landmark* landmark : in_graph) {
    if (std::find(ids.begin(), ids.end(), landmark->id) != ids.end()) wanted.push_back(landmark);
  }
  const CovarianceReport of_wanted = graph_covariance({&own, 1}, in_graph, wanted, config_.graph);
  CovarianceReport report{std::vector<Eigen::MatrixXd>(ids.size()), of_wanted.marginal};
  for (std::size_t w = 0; w < wanted.size(); ++w) {
    const auto at = std::find(ids.begin(), ids.end(), wanted[w]->id);
    report.covariances[static_cast<std::size_t>(at - ids.begin())] =
        named_covariance(*wanted[w], of_wanted.covariances[w]);
  }
  return report;
}

}  // namespace saker::slam
