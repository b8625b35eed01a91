#pragma once

#include <Eigen/Core>
#include <vector>

#include "saker/core/time.h"

namespace saker::active {

/// From where a target was in view, and for how long: facts of the flight, in bins of direction and
/// range so that there are never many. What they are worth follows from the target's estimate,
/// which changes: the cells are looked up anew each time.
class Looks {
 public:
  struct Look {
    Eigen::Vector3d eye = Eigen::Vector3d::Constant(NAN);  ///< world, m, mean
    double seconds = 0;
    double flown_m = NAN;  ///< by the vehicle since the tour began, mean
    int bin = -1;
  };

  /// \param bearings directions that are told apart.
  /// \param range_step_m ranges that are.
  Looks(int bearings, double range_step_m) : bearings_(bearings), range_step_m_(range_step_m) {}

  void add(const Eigen::Vector3d& eye, const Eigen::Vector3d& target, double seconds,
           double flown_m);

  [[nodiscard]] const std::vector<Look>& all() const { return looks_; }  ///< in the order of time

  /// Seconds of those that lie within `near_m` of `eye`.
  [[nodiscard]] double seconds_near(const Eigen::Vector3d& eye, double near_m) const;

  /// When the first of them began, m flown; NaN without any.
  [[nodiscard]] double first_m() const { return first_m_; }

 private:
  int bearings_;
  double range_step_m_;
  double first_m_ = NAN;
  std::vector<Look> looks_;  ///< at most one a bin: bearings × ranges in the field of view
};

/// The looks at a target so far, and those of them that a map, which is always late, holds by now.
class LooksAndMap {
 public:
  explicit LooksAndMap(const Looks& none) : so_far_(none), in_map_(none) {}

  /// As `Looks::add`. \param until when the look ended
  void add(Time until, const Eigen::Vector3d& eye, const Eigen::Vector3d& target, double seconds,
           double flown_m);

  /// The map holds what was measured until `stamp`.
  void map_holds(Time stamp);

  [[nodiscard]] const Looks& so_far() const { return so_far_; }
  [[nodiscard]] const Looks& in_map() const { return in_map_; }

 private:
  struct Awaited {
    Time until;
    Eigen::Vector3d eye, target;  // world, m
    double seconds, flown_m;
  };

  Looks so_far_, in_map_;
  std::vector<Awaited> awaited_;  ///< in the order of time
};

}  // namespace saker::active
