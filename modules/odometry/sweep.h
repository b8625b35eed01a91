#pragma once

#include <array>
#include <vector>

#include "saker/core/se3.h"
#include "saker/lidar/scan.h"
#include "saker/odometry/rotation_track.h"

namespace saker::odometry {

/// A rate at the middle of a scan and how fast it changes.
template <class Vector>
struct Glide {
  Vector rate = Vector::Zero();
  Vector change = Vector::Zero();  ///< per second

  /// The motion from the middle to a moment before or after it.
  [[nodiscard]] Vector at(double seconds) const {
    return rate * seconds + change * (0.5 * seconds * seconds);
  }
};

/// How the lidar moved while a scan was taken: its pose at each moment in its own frame at a moment
/// of reference, and with it the way to bring a point to where it would have been measured at that
/// moment. The reference is the middle of the scan for registration (an error of the rate then
/// moves half of the points forth and half of them back, and leaves the pose alone to first order),
/// the stamp for everyone else.
///
/// Poses are kept at 129 knots and points between them are moved linearly: at 10 rad/s the chord's
/// error is under 0.01 mm at 1 m. A point keeps its place where times are missing.
class Sweep {
 public:
  /// The lidar stood still.
  Sweep() = default;

  /// A twist [rotation, translation] per second, in the lidar's own frame. `span`: from the first
  /// point to the stamp.
  [[nodiscard]] static Sweep twisting(const Glide<Vector6d>& twist, Time span);

  /// Rotation as integrated over the scan, and a velocity given in the lidar frame at the middle.
  [[nodiscard]] static Sweep rotating(const RotationTrack& track,
                                      const Glide<Eigen::Vector3d>& velocity, Time span);

  /// The lidar at the stamp, in its frame at the reference.
  [[nodiscard]] const SE3& T_reference_stamp() const { return T_reference_stamp_; }

  /// The same motion with the stamp as reference.
  [[nodiscard]] Sweep referred_to_stamp() const;

  [[nodiscard]] Eigen::Vector3f deskewed(const Eigen::Vector3f& point,
                                         std::int32_t offset_ns) const;

  /// One point a point of the scan; what is not finite stays so.
  [[nodiscard]] std::vector<Eigen::Vector3f> deskewed(const lidar::Scan& scan) const;

  /// Time from the scan's first point to its stamp, at most a second; 0 without times. Offsets out
  /// of it count as its ends.
  [[nodiscard]] static Time span_of(const lidar::Scan& scan);

  /// The scan's middle, whose pose is registered.
  [[nodiscard]] static Time moment_of(const lidar::Scan& scan) {
    const Time span = span_of(scan);
    return scan.stamp - (span - span / 2);
  }

 private:
  using Affine = Eigen::Matrix<float, 3, 4>;
  static constexpr int kSteps = RotationTrack::kSteps;

  void set(int knot, const SE3& T);

  std::array<Affine, kSteps + 1> T_reference_knot_{};
  SE3 T_reference_stamp_ = SE3::Identity();
  Time span_ = 0;
};

}  // namespace saker::odometry
