#pragma once

#include "saker/simulation/world/street_palette.h"
#include "saker/simulation/world/terrain.h"

namespace saker::simulation {

/// Draws what lies on the ground of training's streets, given in street coordinates (s, d).
class GroundPainter {
 public:
  GroundPainter(World& world, const StreetPalette& palette, const Terrain& terrain)
      : world_(&world), palette_(&palette), terrain_(&terrain) {}

  /// A rectangle of another surface, `lift` above the ground.
  void patch(double s, double d, double half_s, double half_d, MaterialId surface,
             double lift = 0.012);
  /// A round or ragged patch: covers of shafts, puddles.
  void blot(double s, double d, double radius, double raggedness, MaterialId surface,
            core::Rng& rng);
  /// A bump or a table across the road, d from `from` to `to`.
  void speed_bump(double s, double from, double to, double length, double height);
  /// Two rails of a tram about the line d.
  void tram_track(double d, double from, double to, double gauge);
  /// Bars of a crosswalk across the road.
  void crosswalk(double s, double from, double to);
  /// Dashes or a full line along the street.
  void line(double d, double from, double to, double dash, double gap, double width);
  /// A raised island with a kerb, along s.
  void island(double s, double d, double half_s, double half_d, double height, MaterialId top);
  /// A path that leads outwards, with steps where the ground climbs steeply.
  void path(double s, double from, double to, double half_s, MaterialId surface);

 private:
  [[nodiscard]] Eigen::Vector3d at(double s, double d, double lift) const {
    return terrain_->point(s, d) + Eigen::Vector3d(0, 0, lift);
  }
  World* world_;
  const StreetPalette* palette_;
  const Terrain* terrain_;
};

/// A copy of a material with another label: a puddle on a sidewalk is sidewalk.
[[nodiscard]] MaterialId labelled(World& world, MaterialId base, std::uint16_t label);

}  // namespace saker::simulation
