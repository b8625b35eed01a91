#pragma once

#include <limits>
#include <vector>

#include "saker/simulation/sensor/ray_caster.h"

namespace saker::simulation {

/// Which of the world's materials are ground: what one lands on is no obstacle.
[[nodiscard]] std::vector<bool> ground_materials(const World& world);

/// Counts what a flying sphere touches, and how near it came: distance of its centre to the nearest
/// triangle of the world that is not ground (each leaf, wire and pane counts, however thin) by
/// Embree's point query. Ask at 50 Hz or more: at 3 m/s that is every 6 cm. What is
/// farther than the least so far is not looked for.
class CollisionMonitor {
 public:
  static constexpr double kReach =
      6;  ///< m from the surface of the sphere: farther is not measured

  CollisionMonitor(const RayCaster& caster, const World& world, double radius_m);

  void check(const Eigen::Vector3d& centre_sim);

  /// Contacts; one lasts until there are 10 cm of clearance again.
  [[nodiscard]] int collisions() const { return collisions_; }
  [[nodiscard]] bool touching() const { return touching_; }
  /// m between the sphere and what is nearest, the least so far; ≤ 0 at a contact.
  [[nodiscard]] double min_clearance() const { return min_clearance_; }
  /// Label (SemanticKITTI) of what was nearest then.
  [[nodiscard]] int nearest_label() const { return nearest_label_; }

 private:
  const RayCaster* caster_;
  const World* world_;
  std::vector<bool> ground_;  // by material
  double radius_;
  int collisions_ = 0;
  bool touching_ = false;
  double min_clearance_ = std::numeric_limits<double>::infinity();
  int nearest_label_ = 0;
};

}  // namespace saker::simulation
