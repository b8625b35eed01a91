#include "flight/mavlink/setpoint_out.h"

#include <algorithm>
#include <cmath>

#include "flight/mavlink/frames.h"
#include "saker/core/se3.h"

namespace saker::flight::mavlink {
namespace {

constexpr std::uint8_t kLocalNed = 1;  // MAV_FRAME
// POSITION_TARGET_TYPEMASK: what is ignored.
constexpr std::uint16_t kNoVelocity = 0x38, kNoAcceleration = 0x1C0, kNoYaw = 0x400,
                        kNoYawRate = 0x800;
constexpr double kMostPlace = 1e4, kMost = 50, kMostYaw = 1e4;  // m; m/s and m/s²; rad

bool within(const Eigen::Vector3d& v, double most) {
  return v.allFinite() && v.cwiseAbs().maxCoeff() <= most;
}

/// Not a number is allowed: it is not asked for then.
bool within_or_none(const Eigen::Vector3d& v, double most) {
  return v.array().isNaN().all() || within(v, most);
}

bool in_range(const Setpoint& s) {
  return s.stamp > 0 && within(s.position, kMostPlace) && within_or_none(s.velocity, kMost) &&
         within_or_none(s.acceleration, kMost) && std::abs(s.yaw) <= kMostYaw;
}

Setpoint standing(const Place& place) {
  Setpoint setpoint;
  setpoint.position = place.position;
  setpoint.velocity.setZero();
  setpoint.acceleration.setZero();
  setpoint.yaw = place.yaw;
  return setpoint;
}

}  // namespace

SetPositionTargetLocalNed to_message(const Setpoint& setpoint, Time host_now) {
  SetPositionTargetLocalNed m;
  m.time_boot_ms = static_cast<std::uint32_t>(host_now / 1'000'000);
  m.coordinate_frame = kLocalNed;
  m.type_mask = kNoYawRate;
  const Eigen::Vector3d p = flipped(setpoint.position);
  m.x = static_cast<float>(p.x());
  m.y = static_cast<float>(p.y());
  m.z = static_cast<float>(p.z());
  const bool has_velocity = setpoint.velocity.allFinite();
  const bool has_acceleration = has_velocity && setpoint.acceleration.allFinite();
  if (has_velocity) {
    const Eigen::Vector3d v = flipped(setpoint.velocity);
    m.vx = static_cast<float>(v.x());
    m.vy = static_cast<float>(v.y());
    m.vz = static_cast<float>(v.z());
  } else {
    m.type_mask |= kNoVelocity;
  }
  if (has_acceleration) {
    const Eigen::Vector3d a = flipped(setpoint.acceleration);
    m.afx = static_cast<float>(a.x());
    m.afy = static_cast<float>(a.y());
    m.afz = static_cast<float>(a.z());
  } else {
    m.type_mask |= kNoAcceleration;
  }
  if (std::isfinite(setpoint.yaw))
    m.yaw = static_cast<float>(flipped_yaw(setpoint.yaw));
  else
    m.type_mask |= kNoYaw;
  return m;
}

bool SetpointOut::hear(const Setpoint& setpoint, Time sensor_now) {
  const bool order = !newest_ || setpoint.stamp > newest_->stamp;
  const bool time = setpoint.expiry > sensor_now && setpoint.stamp >= not_before_;
  if (!in_range(setpoint) || !order || !time) {
    ++counters_.refused;
    return false;
  }
  newest_ = setpoint;
  expiry_ = std::min(setpoint.expiry, sensor_now + from_seconds(config_.most_age_s));
  if (!climb_) held_.reset();
  return true;
}

void SetpointOut::follow(const OdometryReset& reset, Time sensor_now) {
  const SE3& T = reset.T_new_old;
  const auto move = [&](Place& place) {
    place.position = T * place.position;
    place.yaw += reset.yaw;
  };
  if (held_) move(*held_);
  if (climb_) move(climb_->from);
  if (newest_) {
    newest_->position = T * newest_->position;
    newest_->velocity = T.linear() * newest_->velocity;
    newest_->acceleration = T.linear() * newest_->acceleration;
    newest_->yaw += reset.yaw;
  }
  not_before_ = sensor_now;
}

void SetpointOut::climb(const Place& here, double height_m, Time host_now) {
  climb_ = {here, height_m, host_now};
}

void SetpointOut::stop(const Place& here) {
  held_ = here;
  climb_.reset();
  expiry_ = 0;
}

void SetpointOut::clear() {
  newest_.reset();
  held_.reset();
  climb_.reset();
  expiry_ = 0;
  not_before_ = 0;
}

SetPositionTargetLocalNed SetpointOut::tick(const Place& here, Time sensor_now, Time host_now) {
  ++counters_.sent;
  if (climb_) return climb_target(here, host_now);
  if (fresh(sensor_now) && !held_) return to_message(*newest_, host_now);
  if (!held_) {
    counters_.expired += newest_.has_value();
    held_ = here;
  }
  return to_message(standing(*held_), host_now);
}

SetPositionTargetLocalNed SetpointOut::climb_target(const Place& here, Time host_now) {
  const double risen = config_.climb_speed * to_seconds(host_now - climb_->began);
  Setpoint target = standing(climb_->from);
  target.position.z() += std::min(risen, climb_->height_m);
  if (risen < climb_->height_m) target.velocity.z() = config_.climb_speed;
  const double top = climb_->from.position.z() + climb_->height_m;
  if (here.position.z() > top - config_.reached_m && risen >= climb_->height_m) {
    held_ = Place{target.position, climb_->from.yaw};
    climb_.reset();
  }
  return to_message(target, host_now);
}

}  // namespace saker::flight::mavlink
