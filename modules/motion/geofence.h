#pragma once

#include <Eigen/Core>
#include <vector>

#include "saker/core/config.h"

namespace saker::motion {

/// Where the vehicle may fly, in `world`: an upright prism.
struct GeofenceConfig {
  double lowest_m = 0.8;
  double highest_m = 15;
  std::vector<double> polygon_m = {-100, -100, 100, -100, 100, 100, -100, 100};

  template <class Visitor>
  void visit(Visitor& v) {
    v.setting("lowest_m", lowest_m, {-100, 1000}, "m",
              "The body's centre stays above this height over the take-off point.");
    v.setting("highest_m", highest_m, {-100, 1000}, "m",
              "The body's centre stays below this height over the take-off point.");
    v.setting("polygon_m", polygon_m, {-1e5, 1e5}, "m",
              "Corners x1, y1, x2, y2, … of the area that is flown in, from the take-off point.");
  }
};

/// Used by the planner, which stays inside, and by safety, which holds outside.
class Geofence {
 public:
  /// Throws Error on an odd number of coordinates, fewer than three corners or an empty band.
  explicit Geofence(const GeofenceConfig& config);

  /// Metres to the nearest face: positive inside, negative outside.
  [[nodiscard]] double inside_m(const Eigen::Vector3d& p_world) const;
  /// The same to the upright faces alone, and to top and bottom alone.
  [[nodiscard]] double inside_polygon_m(const Eigen::Vector2d& p_world) const;
  [[nodiscard]] double inside_band_m(double z) const;
  [[nodiscard]] const std::vector<Eigen::Vector2d>& corners() const { return corners_; }
  [[nodiscard]] bool contains(const Eigen::Vector3d& p_world) const {
    return inside_m(p_world) >= 0;
  }

 private:
  double lowest_m_;
  double highest_m_;
  std::vector<Eigen::Vector2d> corners_;
};

}  // namespace saker::motion
