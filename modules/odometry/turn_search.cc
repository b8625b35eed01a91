#include "saker/odometry/turn_search.h"

#include <fmt/format.h>

#include <cmath>

namespace saker::odometry {

std::unique_ptr<TurnFinder> TurnSearch::fresh() const {
  return std::make_unique<TurnFinder>(config_, voxel_m_, most_voxels_);
}

TurnFinder& TurnSearch::finder() {
  if (!finder_) finder_ = fresh();
  return *finder_;
}

bool TurnSearch::decide() {
  if (!finder_) return false;
  return turn_ ? drop() : take();
}

bool TurnSearch::take() {
  turn_ = finder_->found();
  compensated_ = !turn_ && finder_->compensated();
  if (turn_) period_ = from_seconds(finder_->usual_period_s());
  if (turn_) finder_ = fresh();
  if (compensated_) finder_.reset();
  return turn_.has_value();
}

bool TurnSearch::drop() {
  compensated_ = finder_->contradicts(*turn_);
  if (compensated_ || finder_->scans() >= config_.trial_scans) finder_.reset();
  if (!compensated_) return false;
  turn_.reset();
  period_ = 0;
  return true;
}

std::string TurnSearch::note() const {
  if (turn_) {
    return fmt::format("times by azimuth, {} from {:.0f} deg: the scans are not compensated",
                       turn_->clockwise ? "clockwise" : "counter-clockwise",
                       turn_->begin_rad * 180 / M_PI);
  }
  if (compensated_) return "points have no times and need none: the scans are compensated";
  if (finder_) return "points have no times, and too little moves to tell whether they need any";
  return "";
}

}  // namespace saker::odometry
