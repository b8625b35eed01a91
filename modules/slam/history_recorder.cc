#include "saker/slam/history_recorder.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "saker/objects/stated_length.h"

namespace saker::slam {
namespace {

using objects::Cuboid;
using objects::Measurement;

const Landmark* find(const std::vector<Landmark>& landmarks, int id) {
  const auto at = std::ranges::lower_bound(landmarks, id, {}, &Landmark::id);
  return at != landmarks.end() && at->id == id ? &*at : nullptr;
}

/// Quarters to the name that detection gives: a cuboid's longer edge is its length.
int turn_to_name(const Model& model) {
  const auto* cuboid = std::get_if<Cuboid>(&model);
  return cuboid != nullptr && cuboid->size.x() < cuboid->size.y() ? 1 : 0;
}

/// Of a cylinder the most that was seen.
double height(const Model& model) {
  const auto* cylinder = std::get_if<objects::Cylinder>(&model);
  return cylinder != nullptr ? cylinder->height : 0;
}

}  // namespace

void HistoryRecorder::measured(const Landmark& landmark, const Candidate& candidate,
                               const LandmarkConfig& config) {
  Track& track = tracks_[landmark.id];
  const Gathered* before = track.gathering ? &*track.gathering : nullptr;
  Gathered next = gathered(landmark, candidate, config, before);
  if (before == nullptr) {
    track.gathering = std::move(next);
  } else if (agree(*before, next)) {
    Gathered& all = *track.gathering;
    const double highest = std::max(height(before->observation.measured.model),
                                    height(next.observation.measured.model));
    join(all.observation, next.observation);
    if (auto* cylinder = std::get_if<objects::Cylinder>(&all.observation.measured.model))
      cylinder->height = highest;
    for (std::size_t i = 0; i < all.class_log.size(); ++i) all.class_log[i] += next.class_log[i];
    all.front_log_odds += next.front_log_odds;
    all.points += next.points;
    all.length_sd = std::min(all.length_sd, next.length_sd);
    all.newest = std::move(next.newest);
  } else {
    if (believed(landmark, config) && !track.complete) track.complete = std::move(track.gathering);
    track.gathering = std::move(next);
  }
}

HistoryRecorder::Gathered HistoryRecorder::gathered(const Landmark& landmark,
                                                    const Candidate& candidate,
                                                    const LandmarkConfig& config,
                                                    const Gathered* before) {
  const Measurement& measurement = *candidate.measurement;
  const Model& reference =
      before != nullptr ? before->observation.measured.model : candidate.in_keyframe.model;
  const int turn = turn_between(candidate.in_keyframe.model, reference);
  Gathered result;
  result.observation = {0, candidate.in_keyframe, measurement.view_cell};
  if (is_cuboid(landmark.model)) {
    result.observation.measured = turned(candidate.in_keyframe, turn);
    result.length_sd = length_sd(measurement);
  }
  result.newest = measurement;
  result.class_log = clamped_log(measurement.class_probability, config.class_clamp);
  if (std::isfinite(measurement.front_log_odds)) {
    result.front_log_odds = turned(Eigen::Vector2d(measurement.front_log_odds, 0), turn).x();
  }
  result.points = measurement.points;
  return result;
}

bool HistoryRecorder::agree(const Gathered& a, const Gathered& b) const {
  if (a.observation.cell != b.observation.cell) return false;
  const Gaussian &before = a.observation.measured, &now = b.observation.measured;
  const Eigen::VectorXd error = difference(now.model, before.model);
  const double squared = error.dot((before.covariance + now.covariance).llt().solve(error));
  return squared <= config_.agreement * config_.agreement * static_cast<double>(error.size());
}

void HistoryRecorder::close(const Keyframe& keyframe, const Keyframe& next,
                            const std::vector<Landmark>& landmarks, const LandmarkConfig& config) {
  std::erase_if(tracks_,
                [&](const auto& track) { return find(landmarks, track.first) == nullptr; });
  if (static_cast<int>(history_.entries.size()) < config_.most_entries) {
    HistoryEntry entry{keyframe.stamp, keyframe.T_odom_lidar, keyframe.covariance, {}};
    write_moving(entry, landmarks);
    write_due(entry, landmarks, config);
    history_.entries.push_back(std::move(entry));
  }
  carry_to(next, keyframe.T_odom_lidar.inverse() * next.T_odom_lidar);
}

void HistoryRecorder::write_moving(HistoryEntry& entry, const std::vector<Landmark>& landmarks) {
  for (auto& [id, track] : tracks_) {
    if (!find(landmarks, id)->moving) continue;
    if (track.last) {
      const HistoryEntry& then = history_.entries[track.last->entry];
      Measurement last = then.measurements[track.last->measurement];
      last.model =
          objects::transformed(entry.T_odom_lidar.inverse() * then.T_odom_lidar, last.model);
      last.stamp = entry.stamp;
      last.moving = true;
      entry.measurements.push_back(std::move(last));
    }
    track = {};
  }
}

void HistoryRecorder::write_due(HistoryEntry& entry, const std::vector<Landmark>& landmarks,
                                const LandmarkConfig& config) {
  const auto waited = [](const Track& track) {
    return (track.complete ? *track.complete : *track.gathering).age;
  };
  std::vector<Track*> due;
  for (auto& [id, track] : tracks_) {
    if (!track.gathering && !track.complete) continue;
    if (!believed(*find(landmarks, id), config)) continue;
    if (track.complete || !track.last || track.gathering->age >= config_.gather_keyframes)
      due.push_back(&track);
  }
  std::ranges::stable_sort(due, std::greater{}, [&](const Track* t) { return waited(*t); });
  for (Track* track : due) {
    if (static_cast<int>(entry.measurements.size()) >= config_.most_measurements) return;
    write(entry, *track);
  }
}

void HistoryRecorder::write(HistoryEntry& entry, Track& track) {
  std::optional<Gathered>& which = track.complete ? track.complete : track.gathering;
  Measurement measurement = std::move(which->newest);
  Gaussian measured = std::move(which->observation.measured);
  const int turn = turn_to_name(measured.model);
  if (turn != 0) measured = turned(measured, turn);
  measurement.stamp = entry.stamp;
  measurement.model = measured.model;
  measurement.covariance = measured.covariance;
  measurement.class_probability = normalised(which->class_log);
  const auto& p = measurement.class_probability;
  measurement.class_id =
      static_cast<objects::ClassId>(std::max_element(p.begin(), p.end()) - p.begin());
  measurement.front_log_odds = turned(Eigen::Vector2d(which->front_log_odds, 0), turn).x();
  measurement.points = which->points;
  if (is_cuboid(measured.model)) measurement.length_sd = which->length_sd;
  track.last = {history_.entries.size(), entry.measurements.size()};
  entry.measurements.push_back(std::move(measurement));
  which.reset();
}

void HistoryRecorder::carry_to(const Keyframe& next, const SE3& T_keyframe_next) {
  const Matrix6d A = core::se3_adjoint(T_keyframe_next);
  const Matrix6d covariance = A * next.covariance * A.transpose();
  const SE3 T_next_keyframe = T_keyframe_next.inverse();
  for (auto& [id, track] : tracks_) {
    for (std::optional<Gathered>* each : {&track.gathering, &track.complete}) {
      if (!*each) continue;
      Gaussian& measured = (*each)->observation.measured;
      measured = transformed(T_next_keyframe, covariance, measured);
      ++(*each)->age;
    }
  }
}

}  // namespace saker::slam
