#include "made_scene.h"

#include <algorithm>
#include <cmath>

namespace saker::detection::testing {
namespace {

constexpr std::uint8_t kGround = 4;  // its class

SE3 pose_of(const MadeBox& box) {
  SE3 T = SE3::Identity();
  T.linear() = Eigen::AngleAxisd(box.yaw, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  T.translation() = Eigen::Vector3d(box.x, box.y, box.z + 0.5 * box.height);
  return T;
}

Eigen::Vector3d half_of(const MadeBox& box) {
  return 0.5 * Eigen::Vector3d(box.length, box.width, box.height);
}

}  // namespace

bool hides(const MadeBox& box, const Eigen::Vector3d& sensor, const Eigen::Vector3d& point) {
  constexpr int kSteps = 1000;
  const SE3 T_box_world = pose_of(box).inverse();
  const Eigen::Vector3d from = T_box_world * sensor, to = T_box_world * point;
  for (int i = 1; i < kSteps; ++i) {
    const Eigen::Vector3d at = from + (to - from) * i / kSteps;
    if ((at.cwiseAbs() - half_of(box)).maxCoeff() < 0) return true;
  }
  return false;
}

std::vector<Eigen::Vector3d> visible_box(const MadeBox& box, const Eigen::Vector3d& sensor,
                                         int points, double noise, core::Rng& rng) {
  const SE3 T = pose_of(box);
  const Eigen::Vector3d half = half_of(box);
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

Beams ground_beams(const Eigen::Vector3d& sensor, const std::vector<MadeBox>& boxes, int beams,
                   const std::vector<Eigen::Vector3d>& hits) {
  core::Rng rng(6);
  Window window;
  window.sensors = {sensor};
  for (int i = 0; i < beams; ++i) {
    const Eigen::Vector3d ground(rng.uniform(-10, 30), rng.uniform(-20, 20), 0);
    const auto hidden = [&](const MadeBox& box) { return hides(box, sensor, ground); };
    if (std::ranges::none_of(boxes, hidden)) window.beams.push_back({ground.cast<float>()});
  }
  for (const Eigen::Vector3d& hit : hits) window.beams.push_back({hit.cast<float>()});
  Beams made;
  made.fill(window);
  return made;
}

void SceneBuilder::add(const std::vector<Eigen::Vector3d>& more, std::uint8_t class_id,
                       float class_probability) {
  points.insert(points.end(), more.begin(), more.end());
  probability.insert(probability.end(), more.size(), class_probability);
  classes.insert(classes.end(), more.size(), class_id);
}

void SceneBuilder::add_ground(double slope, double half, core::Rng& rng) {
  std::vector<Eigen::Vector3d> ground;
  for (int i = 0; i < 40000; ++i) {
    const double x = rng.uniform(-half, half);
    ground.emplace_back(x, rng.uniform(-half, half), slope * x + rng.normal(0, 0.02));
  }
  add(ground, kGround);
}

LabelledScan SceneBuilder::scan(double seconds, const SE3& T_odom_lidar) const {
  auto cloud = std::make_shared<std::vector<Eigen::Vector3f>>();
  auto labels = std::make_shared<lidar::Labels>();
  for (std::size_t i = 0; i < points.size(); ++i) {
    const auto hidden = [&](const MadeBox& box) {
      return hides(box, T_odom_lidar.translation(), points[i]);
    };
    if (classes[i] == kGround && std::ranges::any_of(solids, hidden)) continue;
    cloud->push_back((T_odom_lidar.inverse() * points[i]).cast<float>());
    labels->classes.push_back(classes[i]);
    labels->probability.push_back(probability[i]);
  }
  return {from_seconds(seconds), T_odom_lidar, cloud, labels};
}

}  // namespace saker::detection::testing
