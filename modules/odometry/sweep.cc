#include "odometry/sweep.h"

#include <algorithm>

namespace saker::odometry {

void Sweep::set(int knot, const Eigen::Matrix3d& R, const Eigen::Vector3d& t) {
  T_stamp_knot_[knot].leftCols<3>() = R.cast<float>();
  T_stamp_knot_[knot].col(3) = t.cast<float>();
}

Sweep Sweep::twisting(const Glide<Vector6d>& twist, Time span) {
  Sweep sweep;
  sweep.span_ = span;
  for (int k = 0; k <= kSteps; ++k) {
    const double seconds = to_seconds(span) * (static_cast<double>(k) / kSteps - 1);
    const SE3 T = core::se3_exp(twist.at(seconds));
    sweep.set(k, T.linear(), T.translation());
  }
  return sweep;
}

Sweep Sweep::rotating(const RotationTrack& track, const Glide<Eigen::Vector3d>& velocity,
                      Time span) {
  Sweep sweep;
  sweep.span_ = span;
  for (int k = 0; k <= kSteps; ++k) {
    const double seconds = to_seconds(span) * (static_cast<double>(k) / kSteps - 1);
    sweep.set(k, track.R_begin_end().transpose() * track.R_begin_knot[k], velocity.at(seconds));
  }
  return sweep;
}

Eigen::Vector3f Sweep::deskewed(const Eigen::Vector3f& point, std::int32_t offset_ns) const {
  if (span_ == 0) return point;
  const float at = kSteps * (1 + static_cast<float>(offset_ns) / static_cast<float>(span_));
  const float clamped = std::clamp(at, 0.0f, static_cast<float>(kSteps));
  const int k = std::min(static_cast<int>(clamped), kSteps - 1);
  const float ratio = clamped - static_cast<float>(k);
  const Affine T = T_stamp_knot_[k] + ratio * (T_stamp_knot_[k + 1] - T_stamp_knot_[k]);
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
  return -std::min<Time>(0, *std::min_element(scan.offset_ns.begin(), scan.offset_ns.end()));
}

}  // namespace saker::odometry
