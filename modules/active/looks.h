#pragma once

#include <Eigen/Core>
#include <vector>

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

  /// When the first of them began, m flown; NaN without any.
  [[nodiscard]] double first_m() const { return first_m_; }

 private:
  int bearings_;
  double range_step_m_;
  double first_m_ = NAN;
  std::vector<Look> looks_;  ///< at most one a bin: bearings × ranges in the field of view
};

}  // namespace saker::active
