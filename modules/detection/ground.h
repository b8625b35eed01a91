#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

#include "saker/core/config.h"
#include "saker/detection/window.h"
#include "saker/objects/models.h"

/// Local ground planes on a grid, after the ground features of Chen et al., "SLOAM", RA-L 2020.
///
/// Reads ground-labelled points in a levelled frame (z roughly up); makes a plane a cell. Each
/// plane is fitted to the mean points of small squares in and around its cell by reweighted least
/// squares with a Cauchy weight whose scale shrinks, so that bonnets and kerbs that were called
/// ground do not bend it, with the slope of its surroundings as prior, for where few squares
/// were seen a bonnet would tilt it; what lies over a vehicle's points is left out beforehand. A
/// plane that stands off its neighbours is refused. Cost: linear in points, about 5 ms for 200,000.
namespace saker::detection {

struct GroundConfig {
  double cell_m = 3;
  int squares = 4;
  int least_squares = 5;
  double reach_m = 6;
  double noise_m = 0.1;
  double outlier_m = 0.1;
  double surroundings_m = 9;
  double slope_sd = 0.15;
  double bend_sd = 0.03;
  double most_slope_deg = 30;
  double most_step_m = 0.5;
  double most_over_m = 0.3;

  template <class Visitor>
  void visit(Visitor& v) {
    v.field("cell_m", cell_m, {0.5, 20}, "m", "edge of a cell, one plane each: half a vehicle");
    v.field("squares", squares, {1, 16}, "",
            "squares a cell's edge is divided into; each counts once, so that near ground, where "
            "points are dense, does not outvote the rest");
    v.field("least_squares", least_squares, {3, 1000}, "",
            "squares seen in and around a cell for a plane");
    v.field("reach_m", reach_m, {0, 50}, "m",
            "how far outside the seen ground its nearest plane is still believed");
    v.field("noise_m", noise_m, {0.001, 1}, "m",
            "standard deviation of a square's height, with what neighbours share of it: the edge "
            "of a bonnet or a load bed that was called ground");
    v.field("outlier_m", outlier_m, {0.01, 1}, "m",
            "last scale of the Cauchy weight: height at which a square counts half");
    v.field("surroundings_m", surroundings_m, {0, 100}, "m",
            "to each side of a cell: over that much ground bends little");
    v.field("slope_sd", slope_sd, {0.001, 2}, "",
            "prior of the surroundings' slope against up: of streets in hills");
    v.field("bend_sd", bend_sd, {0.001, 2}, "",
            "of a cell's slope against its surroundings': holds one that is seen in a line, or of "
            "which a load bed is a part; without it planes were off by 6 degrees and more in 1 "
            "of 70 windows of vehicles, a quarter of all false ends");
    v.field("most_slope_deg", most_slope_deg, {1, 80}, "deg", "a steeper plane is refused");
    v.field("most_step_m", most_step_m, {0.05, 10}, "m",
            "a plane that is farther off the median of its neighbours is refused");
    v.field("most_over_m", most_over_m, {0, 10}, "m",
            "a square that lies farther over a vehicle's point in it or beside it is no ground, "
            "but a bonnet: more than ground rises from one square to the next");
  }
};

class Ground {
 public:
  explicit Ground(const GroundConfig& config) : config_(config) {}

  /// Replaces what was known. Points farther than `range` from the origin are ignored.
  /// \param vehicles  of which ground lies below
  void fit(const std::vector<Eigen::Vector3f>& points, const std::vector<ClassPoint>& vehicles,
           double range);

  /// The plane of the cell under p, or the nearest one within reach; none where ground was not
  /// seen.
  [[nodiscard]] const objects::GroundPlane* at(const Eigen::Vector3d& p) const;

  /// In the frame of the points, in the order of the grid.
  [[nodiscard]] std::vector<objects::GroundPlane> planes() const;

 private:
  struct Square {
    Eigen::Vector3f sum = Eigen::Vector3f::Zero();
    int count = 0;
    float lowest = std::numeric_limits<float>::infinity();  ///< of a vehicle's points, m
  };

  void accumulate(const std::vector<Eigen::Vector3f>& points,
                  const std::vector<ClassPoint>& vehicles);
  [[nodiscard]] Square* square_at(const Eigen::Vector3f& p);
  void leave_out_bonnets();
  [[nodiscard]] float lowest_about(int column, int row) const;
  [[nodiscard]] const std::vector<Eigen::Vector3d>& support(int column, int row);
  void average_cells();
  [[nodiscard]] Eigen::Vector2d slope_about(int column, int row) const;
  [[nodiscard]] std::optional<objects::GroundPlane> fit_cell(int column, int row);
  [[nodiscard]] bool stands_off(int column, int row) const;
  [[nodiscard]] Eigen::Vector2d centre(int column, int row) const;
  [[nodiscard]] const std::optional<objects::GroundPlane>& cell(int column, int row) const {
    return cells_[static_cast<std::size_t>(row) * size_ + column];
  }

  GroundConfig config_;
  int size_ = 0;     ///< cells along an edge of the grid
  double half_ = 0;  ///< half an edge of the grid, m
  std::vector<Square> squares_;
  std::vector<Eigen::Vector3d> means_;  ///< of the cells' squares; NaN where none was seen
  std::vector<std::optional<objects::GroundPlane>> cells_;
  std::vector<Eigen::Vector3d> support_;
};

}  // namespace saker::detection
