#pragma once

#include <functional>
#include <string>
#include <vector>

#include "saker/core/config.h"
#include "saker/occupancy/grid.h"

/// Whether a place is fit to land on, by what was seen of it on the way — reads a block of
/// occupancy, makes the fault of a place and the best place near one (for planning).
///
/// Frame: `odom`, z up. From the body's height down, the first occupied cell of each column of
/// cells is its surface. A place is a disc of `radius_m`: fit where enough columns have a surface,
/// these lie on a plane that is level enough, none stands out of it, and the disc is not far above
/// what surrounds it (the roof of a vehicle is flat, too). A column without a surface was not seen
/// or swallowed every beam: water, glass, a hole. What is lower than a cell (0.25 m) is not seen,
/// nor what came under the vehicle after it was last in view: a lidar of 45° sees the ground from
/// 7 m on when it is 3 m high. Where the vehicle stood before take-off there is ground, though the
/// lidar cannot see it there. Cost: some 20 µs a place, at 1 Hz on the way down only.
namespace saker::autonomy {

struct LandingConfig {
  double radius_m = 0.75;
  double least_seen_share = 0.5;
  double most_slope_deg = 12;
  double most_off_plane_m = 0.35;
  double most_raised_m = 0.7;
  double around_m = 3.5;
  double search_m = 4;
  double search_step_m = 0.5;
  double stood_radius_m = 1.0;

  template <class Visitor>
  void visit(Visitor& v) {
    v.field("radius_m", radius_m, {0.1, 5}, "m", "of the place: legs, rotors and an error");
    v.field("least_seen_share", least_seen_share, {0, 1}, "",
            "of its columns of cells that have a surface: flat beams leave gaps in the ground");
    v.field("most_slope_deg", most_slope_deg, {1, 45}, "°", "of its plane: legs slide beyond");
    v.field("most_off_plane_m", most_off_plane_m, {0.05, 2}, "m",
            "of a surface over that plane: a cell, and what a slope makes of it");
    v.field("most_raised_m", most_raised_m, {0.1, 5}, "m",
            "of the place over the lower part of what surrounds it");
    v.field("around_m", around_m, {1, 20}, "m", "that is what surrounds it");
    v.field("search_m", search_m, {0, 20}, "m", "from the first place, others are looked for");
    v.field("search_step_m", search_step_m, {0.25, 5}, "m", "between two that are looked at");
    v.field("stood_radius_m", stood_radius_m, {0, 3}, "m",
            "around the place of take-off: the ground that the body hides from the lidar");
  }
};

enum class LandingFault {
  none,
  not_seen,  ///< or nothing answers: water
  object,    ///< something stands there
  slope,
  raised,  ///< a roof, a wall's top
};

[[nodiscard]] const char* to_string(LandingFault fault);

struct LandingPlace {
  Eigen::Vector2d at = Eigen::Vector2d::Constant(NAN);  ///< `odom`, m
  LandingFault fault = LandingFault::not_seen;
  double seen_share = 0;
  double slope_deg = NAN;
  double off_plane_m = NAN;  ///< from its lowest to its highest surface
  double raised_m = NAN;

  [[nodiscard]] bool fit() const { return fault == LandingFault::none; }
  /// The higher, the worse: of two that are not fit the lower one is landed on.
  [[nodiscard]] double badness() const;
  [[nodiscard]] std::string text() const;  ///< "not fit to land on: object (1.2 m)"
};

class LandingLook {
 public:
  explicit LandingLook(const LandingConfig& config);  ///< throws Error on an invalid value

  /// \param from_z  of the body: what is above is not looked at
  /// \param stood   where it stood before take-off, on the ground; NaN: nowhere
  [[nodiscard]] LandingPlace at(const occupancy::OccupancyGrid& grid, const Eigen::Vector2d& place,
                                double from_z, const Eigen::Vector3d& stood) const;

  using Allowed = std::function<bool(const Eigen::Vector2d&)>;
  /// The nearest fit place to `place`, `place` first; where there is none the least bad one.
  /// \param allowed  of another place, `odom`: within the geofence
  [[nodiscard]] LandingPlace near(const occupancy::OccupancyGrid& grid,
                                  const Eigen::Vector2d& place, double from_z,
                                  const Eigen::Vector3d& stood, const Allowed& allowed) const;

 private:
  void judge(const std::vector<Eigen::Vector3d>& surfaces, double cell_m,
             LandingPlace& result) const;
  [[nodiscard]] double lower_around(const occupancy::OccupancyGrid& grid,
                                    const Eigen::Vector2d& place, double from_z) const;

  LandingConfig config_;
  std::vector<Eigen::Vector2d> offsets_;  // of the search, nearest first
};

/// What is over the place of take-off, as far as it was seen from the ground.
struct ColumnLook {
  int free = 0, unknown = 0;  ///< cells
  double lowest_m = NAN;      ///< of what is occupied, over the body; NaN: nothing is

  [[nodiscard]] bool blocked() const { return !std::isnan(lowest_m); }
  [[nodiscard]] double unknown_share() const {
    return free + unknown == 0 ? 1 : static_cast<double>(unknown) / (free + unknown);
  }
};

/// The upright column over `body` (m, odom) from `kOverBody_m` above it. What lies outside of the
/// block was not seen.
[[nodiscard]] ColumnLook look_up(const occupancy::OccupancyGrid& grid, const Eigen::Vector3d& body,
                                 double radius_m, double height_m);
inline constexpr double kOverBody_m = 0.5;  ///< the vehicle's own points reach so far

}  // namespace saker::autonomy
