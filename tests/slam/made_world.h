#pragma once

#include <cmath>
#include <numbers>
#include <vector>

#include "saker/core/rng.h"
#include "saker/slam/slam.h"

/// A made world for tests: vehicles and trunks around a loop, a robot that drives it with noisy
/// odometry and measures what is near with noisy virtual sensors of known covariance.
namespace saker::slam::made {

using objects::Cuboid;
using objects::Cylinder;
using objects::Measurement;
using objects::Model;

constexpr objects::ClassId kVehicle = 1, kTrunk = 2, kPole = 3;

inline std::vector<double> probability(objects::ClassId id, double p = 0.8) {
  std::vector<double> all(5, (1 - p) / 4);
  all[id] = p;
  return all;
}

inline SE3 flat_pose(double x, double y, double z, double yaw) {
  SE3 T = SE3::Identity();
  T.linear() = core::so3_exp({0, 0, yaw});
  T.translation() = Eigen::Vector3d(x, y, z);
  return T;
}

inline Cuboid car(double x, double y, double yaw, double length = 4.4, double width = 1.8) {
  return {flat_pose(x, y, 0.75, yaw), {length, width, 1.5}};
}

inline Cylinder trunk(double x, double y) { return {{x, y, 0}, Eigen::Vector3d::UnitZ(), 0.15, 3}; }

struct TrueObject {
  Model model;
  objects::ClassId class_id;
};

/// Vehicles outside and trunks inside a circle of `radius` m.
inline std::vector<TrueObject> ring_of_objects(double radius, int count) {
  std::vector<TrueObject> all;
  for (int i = 0; i < count; ++i) {
    const double a = 2 * std::numbers::pi * i / count;
    const double out = radius + 6, in = radius - 5;
    all.push_back({car(out * std::cos(a), out * std::sin(a), a + std::numbers::pi / 2), kVehicle});
    all.push_back({trunk(in * std::cos(a), in * std::sin(a)), kTrunk});
  }
  return all;
}

struct Noise {
  double rotation = 0.002, translation = 0.02;  ///< odometry, a step
  double object_rotation = 0.03, object_translation = 0.1, object_size = 0.15;
  double cylinder_root = 0.05, cylinder_axis = 0.02, cylinder_radius = 0.02;
  double drawn = 1;  ///< of what is stated; 0: measurements agree
};

class Robot {
 public:
  Robot(std::vector<TrueObject> world, const Noise& noise, std::uint64_t seed)
      : world_(std::move(world)), noise_(noise), rng_(seed) {}

  /// The robot is at `T_world_lidar` after `seconds`: what odometry and detection say.
  SlamInput step(double seconds, const SE3& T_world_lidar) {
    SlamInput input;
    input.stamp = from_seconds(seconds);
    input.odometry_covariance = odometry_sd().cwiseAbs2().asDiagonal();
    if (!started_) {
      T_start_ = T_world_lidar;
    } else {
      const SE3 motion = true_pose_.inverse() * T_world_lidar;
      T_odom_lidar_ = T_odom_lidar_ * motion * core::se3_exp(sample(odometry_sd()));
    }
    started_ = true;
    true_pose_ = T_world_lidar;
    input.T_odom_lidar = T_odom_lidar_;
    input.detections.stamp = input.stamp;
    for (const TrueObject& object : world_) see(object, input);
    input.detections.ground.push_back(
        {Eigen::Vector3d::UnitZ(), {3, 0, -T_world_lidar.translation().z()}, 3});
    return input;
  }

  /// Measured model of a true one, noisy, with its covariance.
  Measurement measure(const TrueObject& object, Time stamp) {
    Measurement m;
    m.stamp = stamp;
    m.class_id = object.class_id;
    m.class_probability = probability(object.class_id);
    const Eigen::VectorXd sd = object_sd(object.model);
    m.model = moved(objects::transformed(true_pose_.inverse(), object.model), sample(sd));
    m.covariance = sd.cwiseAbs2().asDiagonal();
    m.front_log_odds = 1;
    m.points = 200;
    return m;
  }

  [[nodiscard]] const SE3& T_start() const {
    return T_start_;
  }  ///< `world` of SLAM in the made world
  [[nodiscard]] const SE3& true_pose() const { return true_pose_; }
  [[nodiscard]] std::vector<TrueObject>& world() { return world_; }
  double range = 15;  ///< m, at which objects are measured

 private:
  void see(const TrueObject& object, SlamInput& input) {
    if ((objects::place(object.model) - true_pose_.translation()).norm() > range) return;
    input.detections.measurements.push_back(measure(object, input.stamp));
  }

  [[nodiscard]] Vector6d odometry_sd() const {
    Vector6d sd;
    sd.head<3>().setConstant(noise_.rotation);
    sd.tail<3>().setConstant(noise_.translation);
    return sd;
  }

  [[nodiscard]] Eigen::VectorXd object_sd(const Model& model) const {
    Eigen::VectorXd sd(is_cuboid(model) ? 9 : 6);
    if (is_cuboid(model)) {
      sd.segment(0, 3).setConstant(noise_.object_rotation);
      sd.segment(3, 3).setConstant(noise_.object_translation);
      sd.segment(6, 3).setConstant(noise_.object_size);
    } else {
      sd.segment(0, 3).setConstant(noise_.cylinder_root);
      sd.segment(3, 2).setConstant(noise_.cylinder_axis);
      sd[5] = noise_.cylinder_radius;
    }
    return sd;
  }

  Eigen::VectorXd sample(const Eigen::VectorXd& sd) {
    Eigen::VectorXd values(sd.size());
    for (Eigen::Index i = 0; i < sd.size(); ++i) values[i] = rng_.normal(0, noise_.drawn * sd[i]);
    return values;
  }

  std::vector<TrueObject> world_;
  Noise noise_;
  core::Rng rng_;
  bool started_ = false;
  SE3 true_pose_ = SE3::Identity(), T_start_ = SE3::Identity(), T_odom_lidar_ = SE3::Identity();
};

/// Poses of a drive around the circle, one every `step` m.
inline std::vector<SE3> loop(double radius, double step, double rounds = 1) {
  std::vector<SE3> poses;
  for (double s = 0; s < rounds * 2 * std::numbers::pi * radius; s += step) {
    const double a = s / radius;
    poses.push_back(
        flat_pose(radius * std::cos(a), radius * std::sin(a), 1.5, a + std::numbers::pi / 2));
  }
  return poses;
}

/// Independent windows and honest covariances.
inline SlamConfig honest_config() {
  SlamConfig config;
  config.measurement_noise = NoiseSource::fixed;
  config.graph.hidden_ends.enabled = false;  // nothing is hidden in this world
  config.graph.robust_scale = 6;             // wide enough for noise that is what it says
  config.noise = {.covariance_scale = 1, .lean_deg = 0, .roof_m = 0};
  config.keyframes.rotation_floor_deg = 1e-4;
  config.keyframes.translation_floor_m = 1e-4;
  return config;
}

}  // namespace saker::slam::made
