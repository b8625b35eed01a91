#pragma once

#include <memory>
#include <optional>
#include <string>

#include "saker/odometry/turn_finder.h"

namespace saker::odometry {

/// What is known of scans without times of points: they are taken at one instant until a turn is
/// found; it is on trial for some scans that have times by it, and dropped for good where those
/// contradict it (TurnFinder::contradicts).
class TurnSearch {
 public:
  /// \param voxel_m, most_voxels  of the local map
  TurnSearch(const TurnFinderConfig& config, double voxel_m, int most_voxels)
      : config_(config), voxel_m_(voxel_m), most_voxels_(most_voxels) {}

  /// More scans would tell more.
  [[nodiscard]] bool open() const { return !compensated_ && (!turn_ || finder_); }

  /// Takes the scans of an open search.
  [[nodiscard]] TurnFinder& finder();

  /// After each scan that it took. \return whether `turn` is another one from now on
  bool decide();

  /// The local map was cleared: what it is of is not known any more, what was found is.
  void clear_map() {
    if (finder_) finder_->clear_map();
  }

  [[nodiscard]] const std::optional<Turn>& turn() const { return turn_; }
  [[nodiscard]] Time period() const { return period_; }  ///< of a sweep; 0 without a turn

  /// As a line; empty where no scan without times was seen.
  [[nodiscard]] std::string note() const;

 private:
  [[nodiscard]] std::unique_ptr<TurnFinder> fresh() const;
  bool take();
  bool drop();

  TurnFinderConfig config_;
  double voxel_m_;
  int most_voxels_;
  std::unique_ptr<TurnFinder> finder_;
  std::optional<Turn> turn_;
  bool compensated_ = false;
  Time period_ = 0;
};

}  // namespace saker::odometry
