#include "saker/odometry/sweep.h"

#include <algorithm>

namespace saker::odometry {
namespace {

/// Seconds from the middle of the scan.
double seconds_at(int knot, Time span) {
  return to_seconds(span) * (static_cast<double>(knot) / RotationTrack::kSteps - 0.5);
}

}  // namespace

void Sweep::set(int knot, const SE3& T) {
  T_reference_knot_[knot] = T.matrix().topRows<3>().cast<float>();
  if (knot == kSteps) T_reference_stamp_ = T;
}

Sweep Sweep::twisting(const Glide<Vector6d>& twist, Time span) {
  Sweep sweep;
  sweep.span_ = span;
  for (int k = 0; k <= kSteps; ++k) sweep.set(k, core::se3_exp(twist.at(seconds_at(k, span))));
  return sweep;
}

Sweep Sweep::rotating(const RotationTrack& track, const Glide<Eigen::Vector3d>& velocity,
                      Time span) {
  Sweep sweep;
  sweep.span_ = span;
  const Eigen::Matrix3d R_middle_begin = track.R_begin_knot[kSteps / 2].transpose();
  for (int k = 0; k <= kSteps; ++k) {
    SE3 T = SE3::Identity();
    T.linear() = R_middle_begin * track.R_begin_knot[k];
    T.translation() = velocity.at(seconds_at(k, span));
    sweep.set(k, T);
  }
  return sweep;
}

Sweep Sweep::referred_to_stamp() const {
  Sweep sweep = *this;
  const Eigen::Isometry3f T_stamp_reference = T_reference_stamp_.inverse().cast<float>();
  for (Affine& T : sweep.T_reference_knot_) {
    const Affine moved = T_stamp_reference.linear() * T;
    T = moved;
    T.col(3) += T_stamp_reference.translation();
  }
  sweep.T_reference_stamp_.setIdentity();
  return sweep;
}

Eigen::Vector3f Sweep::deskewed(const Eigen::Vector3f& point, std::int32_t offset_ns) const {
  if (span_ == 0) return point;
  const float at = kSteps * (1 + static_cast<float>(offset_ns) / static_cast<float>(span_));
  const float clamped = std::clamp(at, 0.0f, static_cast<float>(kSteps));
  const int k = std::min(static_cast<int>(clamped), kSteps - 1);
  const float ratio = clamped - static_cast<float>(k);
  const Affine T = T_reference_knot_[k] + ratio * (T_reference_knot_[k + 1] - T_reference_knot_[k]);
  return T.leftCols<3>() * point + T.col(3);
}

std::vector<Eigen::Vector3f> Sweep::deskewed(const lidar::Scan& scan) const {
  if (span_ == 0) return scan.points;
  std::vector<Eigen::Vector3f> points(scan.points.size());
  for (std::size_t i = 0; i < points.size(); ++i)
    points[i] = deskewed(scan.points[i], scan.offset_ns[i]);
  return points;
}

Time Sweep::span_of(const lidar::Scan& scan) {
  if (scan.offset_ns.size() != scan.points.size() || scan.offset_ns.empty()) return 0;
  const Time first = *std::min_element(scan.offset_ns.begin(), scan.offset_ns.end());
  return std::clamp<Time>(-first, 0, kNanosecondsPerSecond);
}

}  // namespace saker::odometry
