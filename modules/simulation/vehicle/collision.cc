#include "saker/simulation/vehicle/collision.h"

#include <algorithm>

namespace saker::simulation {
namespace {

constexpr double kContactEnds = 0.1;  ///< m

bool is_ground(const Material& material) {
  switch (material.label) {
    case kRoad:
    case kParking:
    case kSidewalk:
    case kOtherGround:
    case kLaneMarking:
    case kTerrain:
      return true;
    default:
      return false;
  }
}

}  // namespace

std::vector<bool> ground_materials(const World& world) {
  std::vector<bool> ground;
  for (const Material& material : world.materials) ground.push_back(is_ground(material));
  return ground;
}

CollisionMonitor::CollisionMonitor(const RayCaster& caster, const World& world, double radius_m)
    : caster_(&caster), world_(&world), ground_(ground_materials(world)), radius_(radius_m) {}

void CollisionMonitor::check(const Eigen::Vector3d& centre_sim) {
  const double matters = std::clamp(min_clearance_, kContactEnds, kReach);
  const auto near =
      caster_->nearest(centre_sim.cast<float>(), static_cast<float>(radius_ + matters), ground_);
  const double clearance = near ? near->distance - radius_ : matters;
  if (near && clearance < min_clearance_) {
    min_clearance_ = clearance;
    nearest_label_ = world_->materials[near->material].label;
  }
  if (clearance <= 0 && !touching_) ++collisions_;
  touching_ = touching_ ? clearance < kContactEnds : clearance <= 0;
}

}  // namespace saker::simulation
