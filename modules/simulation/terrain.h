#pragma once

#include <vector>

#include "simulation/palette.h"

namespace saker::simulation {

/// What a strip along the street is used for: what populate() puts there.
enum class Use {
  none,
  lane,
  parallel_parking,
  perpendicular_parking,
  sidewalk,
  verge,   ///< grass beside a road: signs, poles, bushes
  island,  ///< grass between rows of a car park: trees, lamps
  garden,  ///< lawn in front of houses: hedge or fence, bushes, trees
  lawn,    ///< a park: scattered trees and benches
  tree_row,
  forest,
  buildings,
  thicket,  ///< bushes grown into each other, from the ground up
  barrier,  ///< a guard rail or a wall along the strip
};

/// A band of ground along the street.
struct Strip {
  double width = 3;
  MaterialId surface = 0;
  Use use = Use::none;
  double kerb = 0;   ///< m, step up from the strip before
  double slope = 0;  ///< rise per metre outwards
};

/// The street's section, from its middle line outwards.
struct CrossSection {
  std::vector<Strip> left;
  std::vector<Strip> right;
};

/// The large shape of the ground.
struct TerrainShape {
  double half_length = 95;  ///< m along the street, to both sides of the origin
  double bend_m = 0, bend_period_m = 200, bend_phase = 0;  ///< of the middle line
  double grade = 0;                                        ///< rise along the street
  double side_slope = 0;       ///< rise across, beyond the crossfall of the street
  double relief_m = 0.1;       ///< sd of the long waves of the ground
  double roughness_m = 0.012;  ///< sd of the short ones
  double crossing = 1e9;       ///< s of a crossing street
  double crossing_half_width = 4;
  MaterialId crossing_surface = 0;
};

/// The ground in street coordinates: s along the middle line, d to its left.
class Terrain {
 public:
  Terrain(const TerrainShape& shape, CrossSection section, core::Rng& rng);

  [[nodiscard]] double height(double s, double d) const;
  [[nodiscard]] Eigen::Vector3d point(double s, double d) const;
  [[nodiscard]] double heading(double s) const;

  /// Origin on the ground, x along the street turned by `yaw`, z up.
  [[nodiscard]] SE3 upright(double s, double d, double yaw = 0) const;
  /// The same with z along the ground's normal over the area of a vehicle.
  [[nodiscard]] SE3 on_ground(double s, double d, double yaw = 0) const;

  [[nodiscard]] const TerrainShape& shape() const { return shape_; }
  [[nodiscard]] const CrossSection& section() const { return section_; }
  [[nodiscard]] bool in_crossing(double s, double margin) const;

  void draw(World& world) const;

 private:
  struct Edge {
    double d;     ///< where the strip begins
    double low;   ///< height of the strip before at its end
    double high;  ///< height at the strip's begin
    double slope;
    MaterialId surface;
  };
  struct Wave {
    Eigen::Vector2d k;
    double phase;
    double amplitude;
  };

  [[nodiscard]] std::vector<Edge> edges_of(const std::vector<Strip>& strips) const;
  [[nodiscard]] double offset(double s, double d) const;
  [[nodiscard]] double relief(double s, double d) const;
  void draw_side(World& world, double side) const;
  void draw_band(Pen& pen, double side, const Edge& edge, double end) const;
  void draw_kerb(Pen& pen, double side, const Edge& edge) const;
  [[nodiscard]] Eigen::Vector3d at_height(double s, double d, double offset) const;
  void add_waves(double sd, double shortest, double longest, int count, core::Rng& rng);

  TerrainShape shape_;
  CrossSection section_;
  std::vector<Edge> left_;
  std::vector<Edge> right_;
  std::vector<Wave> waves_;
};

}  // namespace saker::simulation
