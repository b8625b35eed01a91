#include "saker/detection/vehicle_fitter.h"

#include <algorithm>
#include <limits>

namespace saker::detection {

objects::Cuboid upright(double direction, const std::array<Eigen::Vector2d, 2>& plan,
                        const std::array<double, 2>& height) {
  const Eigen::Vector3d low(plan[0].x(), plan[0].y(), height[0]);
  const Eigen::Vector3d high(plan[1].x(), plan[1].y(), height[1]);
  objects::Cuboid box;
  box.pose.linear() = Eigen::AngleAxisd(direction, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  box.pose.translation() = box.pose.linear() * (0.5 * (low + high));
  box.size = high - low;
  return box;
}

double nearest_range(const Eigen::Vector2d& place, const Sight& sight) {
  double range = std::numeric_limits<double>::max();
  for (const Eigen::Vector3d& sensor : sight.sensors) {
    range = std::min(range, (sensor.head<2>() - place).norm());
  }
  return range;
}

}  // namespace saker::detection
