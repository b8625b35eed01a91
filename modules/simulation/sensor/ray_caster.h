#pragma once

#include <memory>
#include <optional>
#include <span>

#include "saker/simulation/world/world.h"

namespace saker::simulation {

/// A ray and what it met first.
struct Shot {
  Eigen::Vector3f origin = Eigen::Vector3f::Zero();      ///< world
  Eigen::Vector3f direction = Eigen::Vector3f::UnitX();  ///< unit
  float near = 0;                                        ///< m, what is nearer is not seen
  float distance = 0;  ///< m from the origin, meaningful where `hit`
  float cosine = 0;    ///< of the angle between the ray and the surface's normal, 0 … 1
  MaterialId material = 0;
  ObjectId object = 0;
  bool hit = false;
};

/// A surface near a point.
struct NearSurface {
  float distance = 0;                               ///< m
  Eigen::Vector3f point = Eigen::Vector3f::Zero();  ///< of it, the nearest one; world
  MaterialId material = 0;
  ObjectId object = 0;
};

/// The world as Embree's bounding volume hierarchy (Wald et al., "Embree", SIGGRAPH 2014).
/// Prototypes are instanced. Refers to `world`, which has to outlive it and must not change.
class RayCaster {
 public:
  explicit RayCaster(const World& world);
  ~RayCaster();
  RayCaster(RayCaster&&) noexcept;

  /// Puts mover `index` of the world somewhere else.
  void move(std::size_t index, const Eigen::Affine3f& T_world_prototype);

  /// Fills in what each ray meets within `far` metres. Rays in an order in which neighbours run
  /// alike are fastest.
  void cast(std::span<Shot> shots, float far) const;

  /// The nearest triangle within `reach` metres of a point, each leaf of a crown counts;
  /// `ignored`: by material.
  [[nodiscard]] std::optional<NearSurface> nearest(const Eigen::Vector3f& point, float reach,
                                                   const std::vector<bool>& ignored) const;

 private:
  struct Scene;
  std::unique_ptr<Scene> scene_;
};

}  // namespace saker::simulation
