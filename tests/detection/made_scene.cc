#include "made_scene.h"

#include <cmath>

namespace saker::detection::testing {

std::vector<Eigen::Vector3d> visible_box(const MadeBox& box, const Eigen::Vector3d& sensor,
                                         int points, double noise, core::Rng& rng) {
  SE3 T = SE3::Identity();
  T.linear() = Eigen::AngleAxisd(box.yaw, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  T.translation() = Eigen::Vector3d(box.x, box.y, 0.5 * box.height);
  const Eigen::Vector3d half(0.5 * box.length, 0.5 * box.width, 0.5 * box.height);
  const Eigen::Vector3d from = T.inverse() * sensor;
  std::vector<Eigen::Vector3d> result;
  while (static_cast<int>(result.size()) < points) {
    const int k = rng.index(3);
    const double side = rng.chance(0.5) ? 1 : -1;
    if (side * from[k] <= half[k] || (k == 2 && side < 0)) continue;
    Eigen::Vector3d p;
    for (int i = 0; i < 3; ++i) p[i] = rng.uniform(-half[i], half[i]);
    p[k] = side * half[k] + rng.normal(0, noise);
    result.push_back(T * p);
  }
  return result;
}

std::vector<Eigen::Vector3d> visible_cylinder(const Eigen::Vector3d& root,
                                              const Eigen::Vector3d& axis, double radius,
                                              double height, const Eigen::Vector3d& sensor,
                                              int points, double noise, core::Rng& rng) {
  const Eigen::Vector3d toward = sensor - root;
  const double facing = std::atan2(toward.y(), toward.x());
  std::vector<Eigen::Vector3d> result;
  for (int i = 0; i < points; ++i) {
    // Uniform across the silhouette, as beams are.
    const double angle = facing + std::asin(rng.uniform(-1, 1));
    const double distance = radius + rng.normal(0, noise);
    const Eigen::Vector3d out(distance * std::cos(angle), distance * std::sin(angle), 0);
    result.push_back(root + rng.uniform(0.2, height) / axis.z() * axis + out);
  }
  return result;
}

void SceneBuilder::add(const std::vector<Eigen::Vector3d>& more, std::uint8_t class_id) {
  points.insert(points.end(), more.begin(), more.end());
  classes.insert(classes.end(), more.size(), class_id);
}

void SceneBuilder::add_ground(double slope, double half, core::Rng& rng) {
  std::vector<Eigen::Vector3d> ground;
  for (int i = 0; i < 40000; ++i) {
    const double x = rng.uniform(-half, half);
    ground.emplace_back(x, rng.uniform(-half, half), slope * x + rng.normal(0, 0.02));
  }
  add(ground, 4);
}

LabelledScan SceneBuilder::scan(double seconds, const SE3& T_odom_lidar) const {
  auto cloud = std::make_shared<std::vector<Eigen::Vector3f>>();
  auto labels = std::make_shared<lidar::Labels>();
  for (const Eigen::Vector3d& p : points) {
    cloud->push_back((T_odom_lidar.inverse() * p).cast<float>());
  }
  labels->classes = classes;
  labels->probability.assign(points.size(), 0.9f);
  return {from_seconds(seconds), T_odom_lidar, cloud, labels};
}

}  // namespace saker::detection::testing
