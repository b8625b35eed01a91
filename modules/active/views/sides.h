#pragma once

#include <vector>

namespace saker::active {

/// From which directions an object was in view, and for how long.
///
/// Reads bearings and times, makes sides: bins of direction with a dwell each, some angle apart.
/// Bearings are in `world`, from the object to the eye.
class Sides {
 public:
  /// \param bins directions that are distinguished.
  /// \param dwell_s in view from one of them, until it counts as a side.
  /// \param separation rad, least angle between two sides.
  Sides(int bins, double dwell_s, double separation)
      : dwell_s_(bins, 0.0), least_dwell_s_(dwell_s), separation_(separation) {}

  /// In view for `seconds` from `bearing` (rad, object to eye). \return whether that made a side.
  bool add(double bearing, double seconds);

  /// Whether a view from there could make another side.
  [[nodiscard]] bool apart(double bearing) const;

  /// From now on sides count that are half as far from those before.
  void also_between() {
    if (!between_) separation_ /= 2;
    between_ = true;
  }

  [[nodiscard]] int count() const { return static_cast<int>(sides_.size()); }

 private:
  std::vector<double> dwell_s_;
  double least_dwell_s_;
  double separation_;
  bool between_ = false;
  std::vector<double> sides_;  ///< rad, middles of their bins
};

}  // namespace saker::active
