#pragma once

#include <optional>

#include "saker/core/config.h"
#include "saker/core/text.h"
#include "saker/motion/clearance.h"
#include "saker/occupancy/grid.h"

namespace saker::autonomy {

struct LandingConfig {
  double clear_m = 0.9;
  double legs_m = 0.6;
  double ground_m = 2.5;
  double stood_m = 1.0;
  double step_m = 0.4;
  double slope_deg = 12;
  double seen_share = 0.5;
  double unseen_share = 0.25;
  double reach_m = 4;

  template <class Visitor>
  void visit(Visitor& v) {
    v.field("clear_m", clear_m, {0.2, 10}, "m",
            "nothing stands so near to where it comes down: its radius, its margin, a gust");
    v.field("legs_m", legs_m, {0.1, 10}, "m", "its legs come down within");
    v.field("ground_m", ground_m, {0.5, 20}, "m", "the ground's plane is fitted so far around");
    v.field("stood_m", stood_m, {0, 10}, "m",
            "around the place of take-off: what was not seen there carried it");
    v.field(
        "step_m", step_m, {0.1, 5}, "m",
        "over the plane: more stands on it; under it: more is a hole. A cell and a half at least");
    v.field("slope_deg", slope_deg, {1, 60}, "°", "steeper, and it may slide or tip");
    v.field("seen_share", seen_share, {0, 1}, "",
            "of the ground under the legs that returned a beam; grass and flat beams leave gaps, "
            "water returns none");
    v.field("unseen_share", unseen_share, {0, 1}, "",
            "of the columns over it with unknown air: more could hide somebody");
    v.field("reach_m", reach_m, {0, 30}, "m", "another place is looked for so far away");
  }
};

enum class Ground {
  not_looked,  ///< no block
  fit,
  occupied,  ///< something stands there: people, a vehicle
  steep,
  no_ground,  ///< no returns where the ground should be: water, a hole
  unseen,     ///< nobody looked there
};

/// What was seen of a place to come down at.
struct LandingPlace {
  Ground ground = Ground::not_looked;
  double value = NAN;  ///< occupied: m over the ground; steep: °
  Eigen::Vector3d above = Eigen::Vector3d::Constant(NAN);  ///< the body, `odom`, when it was judged

  [[nodiscard]] bool fit() const { return ground == Ground::fit; }
  [[nodiscard]] core::Text text() const;
};

/// Where to come down — reads a block of occupancy (from the collision checker), makes whether the
/// ground below a place is fit, and the nearest place that is (for planning and the mission).
///
/// Frame: `odom`. Each column of cells is followed down to the first occupied one. The ground is
/// the plane of the columns around, fitted by least squares to those that are not above it, again
/// and again: what stands on it leaves. A LiDAR does not see straight down: what counts is what was
/// seen on the way there. What was never seen is no ground and hides somebody, but for the air in
/// the take-off's stated column and the ground that the vehicle stood on. Cost: a walk
/// down the columns within `ground_m`; the search does it for some 200 places at most.
class LandingPlaces {
 public:
  LandingPlaces(const LandingConfig& config, const motion::ClearanceConfig& clearance,
                const occupancy::OccupancyGrid& grid, const Eigen::Vector3d& takeoff)
      : config_(config), clearance_(clearance), grid_(grid), takeoff_(takeoff) {}

  /// Below a body at `above`.
  [[nodiscard]] LandingPlace judge(const Eigen::Vector3d& above) const;
  /// Nearest to it, at its height.
  [[nodiscard]] std::optional<LandingPlace> nearest_fit(const Eigen::Vector3d& above) const;

 private:
  struct Column {
    double ground_m = NAN;  // height of the first occupied cell's top; NaN: none
    double unseen_m = NAN;  // height of the highest unknown cell over it; NaN: none
    bool stood = false;
  };
  /// z = offset + slope · (x, y), about the place.
  struct Plane {
    double offset = 0;
    Eigen::Vector2d slope = Eigen::Vector2d::Zero();
    [[nodiscard]] double at(const Eigen::Vector2d& p) const { return offset + slope.dot(p); }
  };
  struct Tally {
    int legs = 0, ground = 0, columns = 0, unseen = 0;
    double highest_m = 0;
  };

  [[nodiscard]] double step_m() const;
  template <class Visit>
  void for_each(const Eigen::Vector3d& above, double radius_m, Visit visit) const;
  [[nodiscard]] Column column(const Eigen::Vector3d& top) const;
  [[nodiscard]] Plane plane(const Eigen::Vector3d& above) const;
  [[nodiscard]] Tally tally(const Eigen::Vector3d& above, const Plane& plane) const;

  const LandingConfig& config_;
  const motion::ClearanceConfig& clearance_;
  const occupancy::OccupancyGrid& grid_;
  Eigen::Vector3d takeoff_;
};

}  // namespace saker::autonomy
