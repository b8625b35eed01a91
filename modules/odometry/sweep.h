#pragma once

#include <array>
#include <span>
#include <vector>

#include "core/se3.h"
#include "lidar/scan.h"
#include "odometry/gyro.h"

namespace saker::odometry {

/// A rate over the interval that ends with a scan, and how fast it changes: with no change, and
/// with any, the motion over the whole interval is mean · interval_s.
template <class Vector>
struct Glide {
  Vector mean = Vector::Zero();
  Vector change = Vector::Zero();  ///< per second
  double interval_s = 0;

  /// The motion from the stamp to a moment before it (`seconds` ≤ 0).
  [[nodiscard]] Vector at(double seconds) const {
    return mean * seconds + change * (0.5 * seconds * (seconds + interval_s));
  }
};

/// How the lidar moved while a scan was taken: its pose at each moment in its own frame at the
/// scan's stamp, and with it the way to bring a point to where it would have been measured at the
/// stamp.
///
/// Poses are kept at 129 knots and points between them are moved linearly: at 10 rad/s the chord's
/// error is under 0.01 mm at 1 m. A point keeps its place where times are missing.
class Sweep {
 public:
  /// The lidar stood still.
  Sweep() = default;

  /// A twist [rotation, translation] per second, in the lidar's own frame.
  [[nodiscard]] static Sweep twisting(const Glide<Vector6d>& twist, Time span);

  /// Rotation as integrated over the scan, and a velocity given in the lidar frame at the stamp.
  [[nodiscard]] static Sweep rotating(const RotationTrack& track,
                                      const Glide<Eigen::Vector3d>& velocity, Time span);

  [[nodiscard]] Eigen::Vector3f deskewed(const Eigen::Vector3f& point,
                                         std::int32_t offset_ns) const;

  /// One point a point of the scan; what is not finite stays so.
  [[nodiscard]] std::vector<Eigen::Vector3f> deskewed(const lidar::Scan& scan) const;

  /// Time from the scan's first point to its stamp; 0 without times. Offsets that are positive
  /// count as 0.
  [[nodiscard]] static Time span_of(const lidar::Scan& scan);

 private:
  using Affine = Eigen::Matrix<float, 3, 4>;
  static constexpr int kSteps = RotationTrack::kSteps;

  void set(int knot, const Eigen::Matrix3d& R, const Eigen::Vector3d& t);

  std::array<Affine, kSteps + 1> T_stamp_knot_{};
  Time span_ = 0;
};

}  // namespace saker::odometry
