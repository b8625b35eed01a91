#include "tools/saker/experiment/reachable_targets.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace saker::tools {
namespace {

constexpr int kBearings = 24;
constexpr double kStep_m = 1;
constexpr double kRise_m = 0.5;

class ViewpointSearch {
 public:
  ViewpointSearch(const ReachableSpace& space, const active::FieldOfViewConfig& view)
      : space_(space),
        view_(view),
        fence_(space.fence),
        ground_(simulation::ground_materials(space.world)) {}

  [[nodiscard]] bool finds_one(int id, const objects::Cuboid& target) const {
    for (double z = space_.fence.lowest_m; z <= space_.fence.highest_m; z += kRise_m) {
      for (double distance = kStep_m; distance <= view_.farthest_m; distance += kStep_m) {
        for (int k = 0; k < kBearings; ++k) {
          const double bearing = 2 * std::numbers::pi * k / kBearings;
          Eigen::Vector3d eye = target.pose.translation();
          eye.x() += distance * std::cos(bearing);
          eye.y() += distance * std::sin(bearing);
          eye.z() = z;
          if (sees(eye, bearing, id, target)) return true;
        }
      }
    }
    return false;
  }

 private:
  [[nodiscard]] bool sees(const Eigen::Vector3d& eye, double bearing, int id,
                          const objects::Cuboid& target) const {
    const Eigen::Vector3d to = target.pose.translation() - eye;
    const double elevation = std::atan2(to.z(), to.head<2>().norm());
    const double yaw = bearing + std::numbers::pi - active::viewing_azimuth(elevation, view_);
    return fence_.contains(eye) && active::in_field_of_view(eye, yaw, target, view_, 0) &&
           clear(eye) && in_sight(eye, to, id);
  }

  [[nodiscard]] bool clear(const Eigen::Vector3d& eye) const {
    const Eigen::Vector3d eye_sim = space_.T_sim_world * eye;
    return !space_.caster.nearest(eye_sim.cast<float>(), static_cast<float>(space_.radius_m),
                                  ground_);
  }

  [[nodiscard]] bool in_sight(const Eigen::Vector3d& eye, const Eigen::Vector3d& to, int id) const {
    simulation::Shot shot;
    shot.origin = (space_.T_sim_world * eye).cast<float>();
    shot.direction = (space_.T_sim_world.linear() * to.normalized()).cast<float>();
    space_.caster.cast({&shot, 1}, static_cast<float>(to.norm()));
    return shot.hit && shot.object == id;
  }

  const ReachableSpace& space_;
  const active::FieldOfViewConfig& view_;
  motion::Geofence fence_;
  std::vector<bool> ground_;  // by material
};

}  // namespace

std::vector<int> reachable_targets(const std::vector<int>& targets, const objects::ObjectMap& truth,
                                   const ReachableSpace& space,
                                   const active::FieldOfViewConfig& view) {
  const ViewpointSearch search(space, view);
  std::vector<int> reachable;
  for (const int id : targets) {
    const auto object = std::ranges::find(truth.objects, id, &objects::MapObject::id);
    if (object == truth.objects.end()) continue;
    const auto* cuboid = std::get_if<objects::Cuboid>(&object->model);
    if (cuboid != nullptr && search.finds_one(id, *cuboid)) reachable.push_back(id);
  }
  return reachable;
}

}  // namespace saker::tools
