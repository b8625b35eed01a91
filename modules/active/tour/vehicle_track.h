#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <optional>

#include "saker/core/se3.h"
#include "saker/core/time.h"

namespace saker::active {

/// Where the vehicle is, and what it did since the last decision; `world`.
class VehicleTrack {
 public:
  /// \return false where the pose is not finite or the stamp is not newer: nothing changes then.
  [[nodiscard]] bool advance(Time stamp, const SE3& T_world_body) {
    if (!T_world_body.matrix().allFinite() || (stamp_ && stamp <= *stamp_)) return false;
    elapsed_s_ = stamp_ ? std::min(to_seconds(stamp - *stamp_), kLongestStep_s) : 0;
    const Eigen::Vector3d position = T_world_body.translation();
    stands_ = (position - position_).norm() < kStanding_m_s * elapsed_s_;
    if (stamp_) flown_m_ += (position - position_).norm();
    stamp_ = stamp;
    position_ = position;
    yaw_ = core::yaw(T_world_body.linear());
    return true;
  }

  [[nodiscard]] Time stamp() const { return stamp_.value_or(0); }  ///< of this decision
  [[nodiscard]] double elapsed_s() const { return elapsed_s_; }    ///< since the last decision
  [[nodiscard]] double flown_m() const { return flown_m_; }        ///< since the first decision
  [[nodiscard]] bool stands() const { return stands_; }            ///< since the last decision
  [[nodiscard]] const Eigen::Vector3d& position() const { return position_; }
  [[nodiscard]] double yaw() const { return yaw_; }

 private:
  static constexpr double kLongestStep_s = 2.0;  // that a decision stands for: two of its periods
  static constexpr double kStanding_m_s = 0.2;   // slower than this is standing

  std::optional<Time> stamp_;
  double elapsed_s_ = 0, flown_m_ = 0, yaw_ = NAN;
  bool stands_ = false;
  Eigen::Vector3d position_ = Eigen::Vector3d::Constant(NAN);
};

}  // namespace saker::active
