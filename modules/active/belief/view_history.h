#pragma once

#include <Eigen/Core>
#include <vector>

#include "saker/core/time.h"

/// From where a target was in view, and for how long.
///
/// Reads the vehicle's pose while a target is in view, makes dwells in bins of direction and range.
/// These are facts of the flight. What they are worth follows from the target's estimate, which
/// changes: `Knowledge` assigns them to cells of the uncertainty model anew each time.
/// Frames: eyes and targets are in `world`. Cost: linear in the bins, of which there are never
/// many.
namespace saker::active {

class ViewHistory {
 public:
  struct Dwell {
    Eigen::Vector3d eye = Eigen::Vector3d::Constant(NAN);  ///< world, m, mean
    double seconds = 0;
    double flown_m = NAN;  ///< by the vehicle since the tour began, mean
    int bin = -1;
  };

  /// \param bearings directions that are distinguished.
  /// \param range_step_m ranges that are.
  ViewHistory(int bearings, double range_step_m)
      : bearings_(bearings), range_step_m_(range_step_m) {}

  void add(const Eigen::Vector3d& eye, const Eigen::Vector3d& target, double seconds,
           double flown_m);

  [[nodiscard]] const std::vector<Dwell>& dwells() const { return dwells_; }  ///< by time

  /// Seconds of the dwells that lie within `near_m` of `eye`.
  [[nodiscard]] double seconds_near(const Eigen::Vector3d& eye, double near_m) const;

  /// The way flown when the first dwell began, m; NaN without any.
  [[nodiscard]] double first_m() const { return first_m_; }

 private:
  int bearings_;
  double range_step_m_;
  double first_m_ = NAN;
  std::vector<Dwell> dwells_;  ///< at most one a bin: bearings × ranges in the field of view
};

/// The views of a target so far, and those of them that the map holds by now: it is always late.
class MappedViewHistory {
 public:
  explicit MappedViewHistory(const ViewHistory& none) : so_far_(none), in_map_(none) {}

  /// As `ViewHistory::add`. \param until when the view ended
  void add(Time until, const Eigen::Vector3d& eye, const Eigen::Vector3d& target, double seconds,
           double flown_m);

  /// The map holds what was measured until `stamp`.
  void map_holds(Time stamp);

  [[nodiscard]] const ViewHistory& so_far() const { return so_far_; }
  [[nodiscard]] const ViewHistory& in_map() const { return in_map_; }

 private:
  struct Awaited {
    Time until;
    Eigen::Vector3d eye, target;  // world, m
    double seconds, flown_m;
  };

  ViewHistory so_far_, in_map_;
  std::vector<Awaited> awaited_;  ///< in the order of time
};

}  // namespace saker::active
