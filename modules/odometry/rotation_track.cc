#include "saker/odometry/rotation_track.h"

#include <algorithm>
#include <cmath>

namespace saker::odometry {
namespace {

/// Walks through samples in the order of time: the rate between the two around a moment, the
/// nearest one outside.
class RateReader {
 public:
  explicit RateReader(std::span<const lidar::ImuSample> imu) : imu_(imu) { advance(); }

  /// Moments must not go back.
  [[nodiscard]] Eigen::Vector3d at(Time moment) {
    while (after_ && after_->stamp <= moment) advance();
    if (!before_) return after_->angular_velocity;
    if (!after_) return before_->angular_velocity;
    const double ratio = static_cast<double>(moment - before_->stamp) /
                         static_cast<double>(after_->stamp - before_->stamp);
    return before_->angular_velocity +
           ratio * (after_->angular_velocity - before_->angular_velocity);
  }

  /// Whether no moment of the interval is farther than `gap` from a sample on a side where it has
  /// none nearer.
  [[nodiscard]] bool covers(Time begin, Time end, Time gap) {
    Time last = begin;
    for (; after_; advance()) {
      if (after_->stamp < begin - gap || after_->stamp > end + gap) continue;
      if (after_->stamp - last > gap) return false;
      last = std::max(last, after_->stamp);
      seen_ = true;
    }
    return seen_ && end - last <= gap;
  }

 private:
  void advance() {
    before_ = after_ ? after_ : before_;
    after_ = nullptr;
    while (next_ < imu_.size() && !after_) {
      const lidar::ImuSample& sample = imu_[next_++];
      const bool newer = !before_ || sample.stamp > before_->stamp;
      if (newer && sample.angular_velocity.allFinite()) after_ = &sample;
    }
  }

  std::span<const lidar::ImuSample> imu_;
  std::size_t next_ = 0;
  const lidar::ImuSample* before_ = nullptr;
  const lidar::ImuSample* after_ = nullptr;
  bool seen_ = false;
};

}  // namespace

RotationTrack RotationTrack::integrated(std::span<const lidar::ImuSample> imu, Time begin, Time end,
                                        const Eigen::Vector3d& bias) {
  RotationTrack track;
  track.R_begin_knot[0].setIdentity();
  RateReader reader(imu);
  const double step = static_cast<double>(end - begin) / kSteps;  // ns
  for (int k = 0; k < kSteps; ++k) {
    const Eigen::Vector3d rate = reader.at(begin + static_cast<Time>((k + 0.5) * step)) - bias;
    track.R_begin_knot[k + 1] = track.R_begin_knot[k] * core::so3_exp(rate * step * 1e-9);
  }
  return track;
}

bool covers(std::span<const lidar::ImuSample> imu, Time begin, Time end, double gap_s) {
  return RateReader(imu).covers(begin, end, from_seconds(gap_s));
}

Eigen::Matrix3d level(std::span<const lidar::ImuSample> imu) {
  Eigen::Vector3d up = Eigen::Vector3d::Zero();
  for (const lidar::ImuSample& sample : imu)
    if (sample.acceleration.allFinite()) up += sample.acceleration;
  if (!(up.norm() > 1e-6)) return Eigen::Matrix3d::Identity();
  up.normalize();
  const double roll = std::atan2(up.y(), up.z());
  const double pitch = std::atan2(-up.x(), std::hypot(up.y(), up.z()));
  return (Eigen::AngleAxisd(pitch, Eigen::Vector3d::UnitY()) *
          Eigen::AngleAxisd(roll, Eigen::Vector3d::UnitX()))
      .toRotationMatrix();
}

}  // namespace saker::odometry
