#pragma once

#include <vector>

#include "saker/simulation/world/palette.h"

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
  // What follows only training's worlds hold.
  houses,    ///< fronts with doors, steps, columns, shops, gates: populate_houses.cc
  industry,  ///< halls, sheds, containers, piles
  border,    ///< a hedge, fence or wall of any kind
  square,    ///< paving with stalls, planters, cafes
};

/// A band of ground along the street.
struct Strip {
  double width = 3;
  MaterialId surface = 0;
  Use use = Use::none;
  double kerb = 0;   ///< m, step up from the strip before
  double slope = 0;  ///< rise per metre outwards
  double rough = 0;  ///< m, sd of the lumps that only this strip has
};

/// The street's section, from its middle line outwards.
struct CrossSection {
  std::vector<Strip> left;
  std::vector<Strip> right;
};

/// A stretch along the street that climbs or falls; what lies beyond keeps the height.
struct Ramp {
  double from = 0, to = 0;  ///< s
  double slope = 0;         ///< rise per metre
};

/// A mound, or with a negative height a hollow: flat within, sloping down over `edge`.
struct Swell {
  double s = 0, d = 0;
  double half_length = 1, half_width = 1;  ///< m of the flat part, along and across
  double edge = 1;                         ///< m
  double height = 0;
};

/// Where the kerbs of one side are lowered for vehicles and prams.
struct DroppedKerb {
  double side = 1;
  double from = 0, to = 0;  ///< s
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
  double step_m = 1;  ///< between the rows of the ground's mesh along the street
  double lump_phase = 0;
  std::vector<Ramp> ramps;
  std::vector<Swell> swells;
  std::vector<DroppedKerb> dropped;
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
    double width;
    double rough;
  };
  struct Wave {
    Eigen::Vector2d k;
    double phase;
    double amplitude;
  };

  [[nodiscard]] std::vector<Edge> edges_of(const std::vector<Strip>& strips) const;
  [[nodiscard]] double offset(double s, double d) const;
  [[nodiscard]] double strip_offset(const Edge& edge, double s, double side, double out) const;
  [[nodiscard]] double lumps(double s, double d) const;
  [[nodiscard]] double lowered(double s, double side) const;
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
