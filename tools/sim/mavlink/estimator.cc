#include "tools/sim/mavlink/estimator.h"

#include <algorithm>
#include <limits>

#include "flight/mavlink/codec.h"
#include "flight/mavlink/frames.h"

namespace saker::tools {
namespace {

using namespace flight::mavlink;

constexpr std::uint8_t kLocalNed = 1, kLocalFrd = 20, kBodyFrd = 12;
constexpr double kOffsetGain = 0.05;      // of an exchange of TIMESYNC
constexpr Time kOtherClock = 50'000'000;  // ns off by more: the clock began anew

Eigen::Vector3d vector_of(float x, float y, float z) {
  return {static_cast<double>(x), static_cast<double>(y), static_cast<double>(z)};
}

}  // namespace

bool EstimatorModel::set_origin(Time now) {
  if (!runs(now) || origin_at_) return false;
  origin_at_ = now;
  return true;
}

bool EstimatorModel::has_origin(Time now) const {
  return origin_at_ && to_seconds(now - *origin_at_) > quirks_.origin_s;
}

bool EstimatorModel::acceptable(const Odometry& m, Time now) {
  if (!is_finite(m)) {
    saw_nan_ = true;
    return false;
  }
  const bool frd = m.frame_id == kLocalFrd || (!quirks_.only_local_frd && m.frame_id == kLocalNed);
  if (!frd || m.child_frame_id != kBodyFrd || m.estimator_type == quirks_.refused_estimator ||
      m.quality < 0 || !rotation_of(m.q[0], m.q[1], m.q[2], m.q[3]).valid)
    return false;
  const double gap = heard_at_ ? to_seconds(now - *heard_at_) : 1e9;
  heard_at_ = now;
  const bool too_soon = taken_at_ && to_seconds(now - *taken_at_) < quirks_.least_gap_s;
  return to_seconds(now) > quirks_.aligned_s && !too_soon && gap <= quirks_.most_gap_s;
}

/// Before its exchanges suffice PX4 believes no stamp; ArduPilot never asks for the other's clock.
Time EstimatorModel::own_time(std::uint64_t microseconds, Time now) {
  const Time theirs = static_cast<Time>(microseconds) * 1000;
  Time stamp = now;
  if (quirks_.trusted_exchanges == 0) {
    stamps_.hear(theirs, now);
    stamp = stamps_.host(theirs).value_or(now);
  } else if (exchanges_ >= quirks_.trusted_exchanges) {
    stamp = theirs + their_offset_;
  }
  return std::min(stamp, now) - from_seconds(quirks_.odometry_delay_s);
}

std::optional<VehicleOdometry> EstimatorModel::hear(const Odometry& m, Time now) {
  if (!acceptable(m, now)) return std::nullopt;
  taken_at_ = now;
  VehicleOdometry odometry;
  odometry.stamp = own_time(m.time_usec, now);
  const Eigen::Matrix3d R = rotation_of(m.q[0], m.q[1], m.q[2], m.q[3]).q.toRotationMatrix();
  odometry.T_odom_body.linear() = R;
  odometry.T_odom_body.translation() = flipped(vector_of(m.x, m.y, m.z));
  odometry.velocity = R * flipped(vector_of(m.vx, m.vy, m.vz));
  odometry.angular_velocity = flipped(vector_of(m.rollspeed, m.pitchspeed, m.yawspeed));
  odometry.covariance = Matrix6d::Identity() * static_cast<double>(m.pose_covariance[0]);
  odometry.status = VehicleOdometryStatus::ok;
  odometry.reset_counter = m.reset_counter;
  return odometry;
}

std::optional<Timesync> EstimatorModel::question(Time now) {
  if (to_seconds(now - asked_at_) < 1 / quirks_.timesync_hz) return std::nullopt;
  asked_at_ = now;
  Timesync message;
  message.ts1 = now;
  return message;
}

void EstimatorModel::hear(const Timesync& answer, Time now) {
  if (answer.ts1 <= 0 || answer.ts1 > now || answer.tc1 <= 0) return;
  const Time offset = (answer.ts1 + now) / 2 - answer.tc1;
  const Time off = offset - their_offset_;
  const bool anew = exchanges_ == 0 || std::abs(off) > kOtherClock;
  their_offset_ = anew ? offset : their_offset_ + static_cast<Time>(kOffsetGain * double(off));
  ++exchanges_;
}

double EstimatorModel::seconds_without(Time now) const {
  return taken_at_ ? to_seconds(now - *taken_at_) : std::numeric_limits<double>::infinity();
}

bool EstimatorModel::lost(Time now) const {
  return taken_at_ && seconds_without(now) >= quirks_.lost_s;
}

std::uint16_t EstimatorModel::flags(Time now) const {
  constexpr std::uint16_t kAbsolute = 16;
  if (!runs(now) || !taken_at_) return 0;
  if (seconds_without(now) >= quirks_.lost_flags_s) return quirks_.no_place_flags;
  const int without = has_origin(now) ? 0 : kAbsolute;
  return static_cast<std::uint16_t>(quirks_.good_flags & ~without);
}

}  // namespace saker::tools
