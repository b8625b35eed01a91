#pragma once

#include "drawn.h"
#include "saker/simulation/world/furnish_street.h"

namespace saker::simulation {

/// Straight level ground with one strip to each side of the middle line, and a site to build on it.
struct MadeSite : Sketch {
  explicit MadeSite(const Population& population = {}, std::uint64_t seed = 1,
                    double crossing = 1e9, double width = 60)
      : Sketch(seed),
        flora(grow_flora(world, palette, rng)),
        terrain(ground(crossing, width, rng)),
        site({world, palette, flora, terrain, population, rng}) {}
  MadeSite(const MadeSite&) = delete;
  MadeSite& operator=(const MadeSite&) = delete;

  /// The strip of a side from `d` on.
  [[nodiscard]] Lot lot(const Strip& strip, double side = 1, double d = 3) const {
    return {&strip, d, side, -90, 90};
  }
  /// Placements of any of the prototypes.
  [[nodiscard]] int placed_of(const std::vector<std::size_t>& prototypes) const {
    int count = 0;
    for (const Placement& p : world.placements)
      count += std::find(prototypes.begin(), prototypes.end(), p.prototype) != prototypes.end();
    return count;
  }
  [[nodiscard]] int objects_of(const std::string& class_name) const {
    int count = 0;
    for (const TrueObject& object : world.objects) count += object.class_name == class_name;
    return count;
  }

  Flora flora;
  Terrain terrain;
  Site site;

 private:
  static Terrain ground(double crossing, double width, core::Rng& rng) {
    TerrainShape shape;
    shape.relief_m = shape.roughness_m = 0;
    shape.crossing = crossing;
    CrossSection section;
    section.left = section.right = {{width, 0, Use::none, 0, 0}};
    return {shape, section, rng};
  }
};

inline const objects::Cuboid& cuboid_of(const TrueObject& object) {
  return std::get<objects::Cuboid>(object.model);
}

/// The outline of a vehicle without a margin, seen from above.
inline std::array<Eigen::Vector2d, 4> footprint_of(const objects::Cuboid& cuboid, double margin) {
  const double x = cuboid.size.x() / 2 - margin, y = cuboid.size.y() / 2 - margin;
  std::array<Eigen::Vector2d, 4> corners;
  const std::array<Eigen::Vector2d, 4> unit = {{{x, y}, {-x, y}, {-x, -y}, {x, -y}}};
  for (std::size_t i = 0; i < 4; ++i)
    corners[i] = (cuboid.pose * Eigen::Vector3d(unit[i].x(), unit[i].y(), 0)).head<2>();
  return corners;
}

/// Whether two vehicles stand in each other: no axis of either separates their outlines.
inline bool overlap(const objects::Cuboid& a, const objects::Cuboid& b, double margin = 0) {
  const auto p = footprint_of(a, margin), q = footprint_of(b, margin);
  for (const objects::Cuboid* of : {&a, &b}) {
    for (int axis = 0; axis < 2; ++axis) {
      const Eigen::Vector2d n = of->pose.linear().col(axis).head<2>();
      double p_low = 1e9, p_high = -1e9, q_low = 1e9, q_high = -1e9;
      for (std::size_t i = 0; i < 4; ++i) {
        p_low = std::min(p_low, n.dot(p[i]));
        p_high = std::max(p_high, n.dot(p[i]));
        q_low = std::min(q_low, n.dot(q[i]));
        q_high = std::max(q_high, n.dot(q[i]));
      }
      if (p_high <= q_low || q_high <= p_low) return false;
    }
  }
  return true;
}

/// Pairs of vehicles that stand in each other by more than a margin.
inline int overlaps(const World& world, double margin = 0) {
  std::vector<const objects::Cuboid*> vehicles;
  for (const TrueObject& object : world.objects) {
    if (object.class_name == "vehicle") vehicles.push_back(&cuboid_of(object));
  }
  int count = 0;
  for (std::size_t i = 0; i < vehicles.size(); ++i) {
    for (std::size_t k = 0; k < i; ++k) count += overlap(*vehicles[i], *vehicles[k], margin);
  }
  return count;
}

}  // namespace saker::simulation
