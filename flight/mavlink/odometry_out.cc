#include "flight/mavlink/odometry_out.h"

#include <algorithm>
#include <cmath>

#include "flight/mavlink/frames.h"

namespace saker::flight::mavlink {
namespace {

constexpr std::uint8_t kLocalFrd = 20, kBodyFrd = 12;              // MAV_FRAME
constexpr std::uint8_t kVio = 3;                                   // MAV_ESTIMATOR_TYPE
constexpr std::int8_t kGoodQuality = 100, kPredictedQuality = 50;  // %
constexpr double kFarthest = 1e4;                                  // m
constexpr double kMostAngularSpeed = 50;                           // rad/s
constexpr double kMostVariance = 1e6;

bool in_range(const VehicleOdometry& o, double most_speed) {
  const auto within = [](const auto& v, double most) {
    return v.allFinite() && v.cwiseAbs().maxCoeff() <= most;
  };
  return o.stamp > 0 && o.T_odom_body.matrix().allFinite() &&
         within(o.T_odom_body.translation(), kFarthest) && within(o.velocity, most_speed) &&
         within(o.angular_velocity, kMostAngularSpeed) && within(o.covariance, kMostVariance);
}

double since(Time begin, Time end) { return to_seconds(end - begin); }

}  // namespace

OdometryOut::Result OdometryOut::hear(const VehicleOdometry& odometry, Time host_now, bool fresh) {
  const bool anew = newest_ && odometry.stamp + kNanosecondsPerSecond < newest_->stamp;
  if (odometry.status == VehicleOdometryStatus::lost) {
    good_since_.reset();
    return {};
  }
  if (!in_range(odometry, config_.most_speed) ||
      (newest_ && odometry.stamp <= newest_->stamp && !anew)) {
    ++counters_.refused;
    return {};
  }
  clock_.hear(odometry.stamp, host_now);
  Result result;
  const bool reset = newest_ && (anew || odometry.reset_counter != newest_->reset_counter);
  if (reset) {
    result.reset = reset_to(odometry);
    ++reset_count_;
    ++counters_.resets;
  } else if (!plausible(odometry)) {
    ++counters_.lies;
    lied_ = true;
    good_since_.reset();
    newest_ = odometry;
    return {};
  }
  newest_ = odometry;
  if (!good_since_) good_since_ = host_now;
  good_at_ = host_now;
  // Where it jumped to is nothing to fly on; later it is the beginning of another odometry.
  if (lied_ && !good(host_now)) return result;
  reset_count_ = static_cast<std::uint8_t>(reset_count_ + lied_);
  lied_ = false;
  if (!reset && (!fresh || host_now < next())) return result;
  const Time host_stamp = std::min(clock_.host(odometry.stamp).value_or(host_now), host_now);
  result.message = message(odometry, host_stamp);
  latency_s_ = since(host_stamp, host_now);
  sent_at_ = host_now;
  ++counters_.sent;
  return result;
}

bool OdometryOut::good(Time host_now) const {
  if (!good_since_ || since(good_at_, host_now) > config_.most_age_s) return false;
  const bool lied = counters_.lies > 0;
  return !lied || since(*good_since_, host_now) >= config_.trust_again_s;
}

bool OdometryOut::plausible(const VehicleOdometry& odometry) {
  if (!newest_) return true;
  if (frozen(odometry)) return false;
  const double dt = since(newest_->stamp, odometry.stamp);
  const Eigen::Vector3d moved =
      odometry.T_odom_body.translation() - newest_->T_odom_body.translation();
  const Eigen::Vector3d explained = 0.5 * (odometry.velocity + newest_->velocity) * dt;
  return (moved - explained).norm() <= config_.jump_m + 0.5 * explained.norm();
}

bool OdometryOut::frozen(const VehicleOdometry& odometry) {
  const bool same = odometry.T_odom_body.translation() == newest_->T_odom_body.translation() &&
                    odometry.velocity.norm() > config_.frozen_speed;
  if (!same || same_place_since_ == 0) same_place_since_ = odometry.stamp;
  return since(same_place_since_, odometry.stamp) > config_.frozen_s;
}

OdometryReset OdometryOut::reset_to(const VehicleOdometry& odometry) const {
  // Where the body is now, by the old odometry: it went on as it moved.
  SE3 T_old_body = newest_->T_odom_body;
  const double dt = std::clamp(since(newest_->stamp, odometry.stamp), 0.0, config_.most_age_s);
  T_old_body.translation() += newest_->velocity * dt;
  const double yaw = core::yaw(odometry.T_odom_body.rotation() * T_old_body.rotation().transpose());
  // Both are level: they differ by a heading and a place.
  SE3 T_new_old = SE3::Identity();
  T_new_old.linear() = Eigen::AngleAxisd(yaw, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  T_new_old.translation() =
      odometry.T_odom_body.translation() - T_new_old.linear() * T_old_body.translation();
  return {T_new_old, yaw};
}

Odometry OdometryOut::message(const VehicleOdometry& odometry, Time host_stamp) const {
  const Eigen::Matrix3d R = odometry.T_odom_body.rotation();
  const Eigen::Vector3d p = flipped(Eigen::Vector3d(odometry.T_odom_body.translation()));
  const Eigen::Vector3d v = flipped(Eigen::Vector3d(R.transpose() * odometry.velocity));
  const Eigen::Vector3d w = flipped(odometry.angular_velocity);
  Odometry m;
  m.time_usec = static_cast<std::uint64_t>(std::max<Time>(host_stamp, 0) / 1000);
  m.x = static_cast<float>(p.x());
  m.y = static_cast<float>(p.y());
  m.z = static_cast<float>(p.z());
  m.q = wire_quaternion(flipped(Eigen::Quaterniond(R)));
  m.vx = static_cast<float>(v.x());
  m.vy = static_cast<float>(v.y());
  m.vz = static_cast<float>(v.z());
  m.rollspeed = static_cast<float>(w.x());
  m.pitchspeed = static_cast<float>(w.y());
  m.yawspeed = static_cast<float>(w.z());
  m.pose_covariance = wire_covariance(odometry.covariance, R);
  const auto variance = static_cast<float>(config_.velocity_sd * config_.velocity_sd);
  m.velocity_covariance[0] = m.velocity_covariance[6] = m.velocity_covariance[11] = variance;
  const auto rotation = [&](int row) { return static_cast<float>(odometry.covariance(row, row)); };
  m.velocity_covariance[15] = rotation(0);
  m.velocity_covariance[18] = rotation(1);
  m.velocity_covariance[20] = rotation(2);
  m.frame_id = kLocalFrd;
  m.child_frame_id = kBodyFrd;
  m.reset_counter = reset_count_;
  m.estimator_type = kVio;
  m.quality = odometry.status == VehicleOdometryStatus::ok ? kGoodQuality : kPredictedQuality;
  return m;
}

}  // namespace saker::flight::mavlink
