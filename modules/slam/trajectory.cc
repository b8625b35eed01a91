#include "saker/slam/trajectory.h"

#include <algorithm>
#include <numbers>

namespace saker::slam {
namespace {

constexpr double kRadian = std::numbers::pi / 180;
constexpr double kUnknown = 100;  // times the floor's standard deviation

Matrix6d floored(const Matrix6d& covariance, const KeyframeConfig& config) {
  Vector6d floor;
  floor.head<3>().setConstant(config.rotation_floor_deg * kRadian);
  floor.tail<3>().setConstant(config.translation_floor_m);
  const Matrix6d least = floor.cwiseAbs2().asDiagonal();
  if (!covariance.allFinite() || covariance.diagonal().minCoeff() < 0)
    return kUnknown * kUnknown * least;
  return covariance + least;
}

}  // namespace

const Keyframe* find(const std::vector<Keyframe>& keyframes, int serial) {
  if (keyframes.empty() || serial < keyframes.front().serial) return nullptr;
  return &keyframes[static_cast<std::size_t>(serial - keyframes.front().serial)];
}

Trajectory::Trajectory(const KeyframeConfig& config) : config_(config) {}

bool Trajectory::advance(Time stamp, const SE3& T_odom_lidar, const Matrix6d& covariance) {
  retired_.reset();
  if (keyframes_.empty()) {
    add_keyframe(stamp, T_odom_lidar);
    return true;
  }
  const SE3 before = motion_;
  motion_ = newest().T_odom_lidar.inverse() * T_odom_lidar;
  const Matrix6d A = core::se3_adjoint((before.inverse() * motion_).inverse());
  motion_covariance_ =
      (A * motion_covariance_ * A.transpose() + floored(covariance, config_)).eval();
  if (!far_enough(stamp)) return false;
  add_keyframe(stamp, T_odom_lidar);
  return true;
}

bool Trajectory::far_enough(Time stamp) const {
  return motion_.translation().norm() >= config_.distance_m ||
         core::so3_log(motion_.linear()).norm() >= config_.angle_deg * kRadian ||
         to_seconds(stamp - newest().stamp) >= config_.interval_s;
}

void Trajectory::add_keyframe(Time stamp, const SE3& T_odom_lidar) {
  Keyframe keyframe{0, stamp, T_odom_lidar, T_odom_lidar, motion_covariance_};
  if (!keyframes_.empty()) {
    keyframe.serial = newest().serial + 1;
    keyframe.T_world_lidar = T_world_lidar();
  }
  if (static_cast<int>(keyframes_.size()) >= config_.most) {
    retired_ = keyframes_.front();
    keyframes_.erase(keyframes_.begin());
  }
  keyframes_.push_back(keyframe);
  motion_ = SE3::Identity();
  motion_covariance_.setZero();
}

SE3 Trajectory::T_world_odom() const {
  if (keyframes_.empty()) return SE3::Identity();
  return newest().T_world_lidar * newest().T_odom_lidar.inverse();
}

SE3 Trajectory::corrected(Time stamp, const SE3& T_odom_lidar) const {
  if (keyframes_.empty()) return T_odom_lidar;
  const auto after = std::upper_bound(keyframes_.begin(), keyframes_.end(), stamp,
                                      [](Time t, const Keyframe& k) { return t < k.stamp; });
  const Keyframe& a = after == keyframes_.begin() ? keyframes_.front() : *std::prev(after);
  const SE3 from_a = a.T_world_lidar * a.T_odom_lidar.inverse() * T_odom_lidar;
  if (after == keyframes_.begin() || after == keyframes_.end()) return from_a;
  const Keyframe& b = *after;
  const SE3 b_from_a = a.T_world_lidar * a.T_odom_lidar.inverse() * b.T_odom_lidar;
  const Vector6d gap = core::se3_log(b_from_a.inverse() * b.T_world_lidar);
  const double ratio =
      static_cast<double>(stamp - a.stamp) / static_cast<double>(b.stamp - a.stamp);
  return from_a * core::se3_exp(ratio * gap);
}

}  // namespace saker::slam
