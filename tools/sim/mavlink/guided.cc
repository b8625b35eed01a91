#include "tools/sim/mavlink/guided.h"

#include <algorithm>

#include "flight/mavlink/codec.h"
#include "flight/mavlink/frames.h"
#include "saker/core/se3.h"

namespace saker::tools {
namespace {

using namespace flight::mavlink;

// POSITION_TARGET_TYPEMASK: what is ignored.
constexpr std::uint16_t kNoPlace = 0x7, kNoVelocity = 0x38, kNoAcceleration = 0x1C0, kNoYaw = 0x400,
                        kNoYawRate = 0x800;
constexpr std::uint8_t kLocalNedFrame = 1;
constexpr double kExpiry = 0.25;  // s, of the inner loops' setpoint: it is renewed all the time

std::optional<Eigen::Vector3d> vector_of(std::uint16_t ignored, float x, float y, float z) {
  if (ignored != 0) return std::nullopt;
  return flipped(
      Eigen::Vector3d(static_cast<double>(x), static_cast<double>(y), static_cast<double>(z)));
}

}  // namespace

void Guided::hold(const Eigen::Vector3d& position, double yaw) {
  target_ = {};
  target_.position = position;
  target_.yaw = yaw;
  stands_ = true;
}

bool Guided::hear(const SetPositionTargetLocalNed& m, Time now) {
  const std::uint16_t mask = m.type_mask;
  const bool half = (mask & kNoVelocity) != 0 && (mask & kNoAcceleration) == 0;
  if (m.coordinate_frame != kLocalNedFrame || !is_finite(m) || (half && quirks_.drops_half_targets))
    return false;
  target_.position = vector_of(mask & kNoPlace, m.x, m.y, m.z);
  target_.velocity = vector_of(mask & kNoVelocity, m.vx, m.vy, m.vz);
  target_.acceleration = vector_of(mask & kNoAcceleration, m.afx, m.afy, m.afz);
  if ((mask & kNoYaw) == 0) target_.yaw = flipped_yaw(static_cast<double>(m.yaw));
  target_.yaw_rate = (mask & kNoYawRate) == 0 ? -static_cast<double>(m.yaw_rate) : NAN;
  heard_at_ = now;
  stands_ = false;
  return true;
}

bool Guided::streamed(Time now) const {
  return heard_at_ && to_seconds(now - *heard_at_) < quirks_.setpoint_timeout_s;
}

bool Guided::wants_above(double height) const {
  return target_.position && target_.position->z() > height;
}

/// Where to be `seconds` after the target came: carried on by its velocity where it flies on.
Eigen::Vector3d Guided::place(const CraftState& craft, double seconds) {
  if (!target_.position) target_.position = craft.T_odom_body.translation();
  if (!target_.velocity || stands_) return *target_.position;
  const double carried = std::min(seconds, quirks_.flies_on ? quirks_.setpoint_timeout_s : 0.0);
  return *target_.position + carried * *target_.velocity;
}

Setpoint Guided::setpoint(const CraftState& craft, Time now) {
  const double seconds = heard_at_ ? to_seconds(now - *heard_at_) : 0;
  const bool fresh = !stands_ && streamed(now);
  if (!std::isfinite(target_.yaw)) target_.yaw = core::yaw(craft.T_odom_body.linear());
  Setpoint s;
  s.stamp = now;
  s.expiry = now + from_seconds(kExpiry);
  // A velocity alone is followed from where it is; it stands there when no more come.
  const bool drifts = fresh && !target_.position && target_.velocity;
  s.position = drifts ? Eigen::Vector3d(craft.T_odom_body.translation()) : place(craft, seconds);
  s.velocity = fresh ? target_.velocity.value_or(Eigen::Vector3d::Zero()) : Eigen::Vector3d::Zero();
  s.acceleration =
      fresh ? target_.acceleration.value_or(Eigen::Vector3d::Zero()) : Eigen::Vector3d::Zero();
  s.yaw = target_.yaw;
  s.yaw_rate = fresh && std::isfinite(target_.yaw_rate) ? target_.yaw_rate : 0;
  return s;
}

}  // namespace saker::tools
