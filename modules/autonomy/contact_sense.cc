#include "saker/autonomy/contact_sense.h"

#include <algorithm>

namespace saker::autonomy {

ContactSense::ContactSense(const ContactConfig& config, const SE3& T_body_lidar)
    : config_(core::checked(config, "contact")),
      R_body_lidar_(T_body_lidar.linear()),
      lever_(T_body_lidar.translation()) {}

void ContactSense::add(const lidar::ImuSample& sample) {
  if (!sample.acceleration.allFinite() || !sample.angular_velocity.allFinite()) return;
  const Time window = from_seconds(config_.window_s);
  if (count_ > 0) {
    const Time since = sample.stamp - at(count_ - 1).stamp;
    if (since <= 0) return;
    if (since >= window) count_ = 0;
  }
  drop_before(sample.stamp - window);
  ring_[(first_ + count_) % kMost] = {sample.stamp, R_body_lidar_ * sample.acceleration,
                                      R_body_lidar_ * sample.angular_velocity};
  ++count_;
  judge();
}

void ContactSense::drop_before(Time oldest) {
  while (count_ > 0 && (at(0).stamp <= oldest || count_ == kMost)) {
    settle(at(0));
    first_ = (first_ + 1) % kMost;
    --count_;
  }
}

/// A mean that forgets; of the first `steady_s` a plain one.
void ContactSense::settle(const Reading& old) {
  const double dt = std::min(to_seconds(old.stamp - settled_), config_.window_s);
  settled_ = old.stamp;
  steady_weight_ = std::min(1.0, steady_weight_ + dt / config_.steady_s);
  steady_ += dt / (config_.steady_s * steady_weight_) * (old.force - steady_);
}

/// Without the one that is farthest from the mean of all.
Eigen::Vector3d ContactSense::mean_force() const {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (std::size_t i = 0; i < count_; ++i) sum += at(i).force;
  const Eigen::Vector3d mean = sum / static_cast<double>(count_);
  std::size_t farthest = 0;
  for (std::size_t i = 1; i < count_; ++i) {
    if ((at(i).force - mean).squaredNorm() > (at(farthest).force - mean).squaredNorm())
      farthest = i;
  }
  return (sum - at(farthest).force) / static_cast<double>(count_ - 1);
}

/// At the lever: α × r + ω × (ω × r).
Eigen::Vector3d ContactSense::of_turning() const {
  const Reading &first = at(0), &last = at(count_ - 1);
  const Eigen::Vector3d turn = (last.rate - first.rate) / to_seconds(last.stamp - first.stamp);
  const Eigen::Vector3d rate = 0.5 * (last.rate + first.rate);
  return turn.cross(lever_) + rate.cross(rate.cross(lever_));
}

void ContactSense::judge() {
  if (count_ < kLeast || steady_weight_ < 1) return;
  const Eigen::Vector3d force = mean_force() - of_turning();
  const double sideways = (force - steady_).head<2>().norm();
  const double along =
      force.z() > 0 ? force.z() / config_.upwards_mps2 : -force.z() / config_.downwards_mps2;
  const double across = sideways / config_.sideways_mps2;
  if (std::max(along, across) <= 1) return;
  last_ = {at(count_ - 1).stamp, across > along ? sideways : std::abs(force.z())};
}

}  // namespace saker::autonomy
