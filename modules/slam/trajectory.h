#pragma once

#include <cmath>
#include <optional>
#include <span>
#include <vector>

#include "saker/core/config.h"
#include "saker/core/se3.h"
#include "saker/core/time.h"

namespace saker::slam {

struct KeyframeConfig {
  double distance_m = 1;
  double angle_deg = 15;
  double interval_s = 2;
  int most = 4000;
  double rotation_floor_deg = 0.005;
  double translation_floor_m = 0.003;

  template <class Visitor>
  void visit(Visitor& v) {
    v.field("distance_m", distance_m, {0.05, 100}, "m",
            "motion that makes a keyframe: 600 in ten minutes at 1 m/s");
    v.field("angle_deg", angle_deg, {1, 180}, "degree", "turn that makes a keyframe");
    v.field("interval_s", interval_s, {0.1, 1000}, "s", "time that makes a keyframe");
    v.field("most", most, {10, 100000}, "",
            "keyframes kept; the oldest goes first, with its measurements");
    v.field("rotation_floor_deg", rotation_floor_deg, {1e-4, 10}, "degree",
            "least standard deviation of odometry's turn between two inputs: registration knows "
            "nothing of its bias");
    v.field("translation_floor_m", translation_floor_m, {1e-4, 10}, "m",
            "least standard deviation of odometry's motion between two inputs");
  }
};

struct Keyframe {
  int serial = 0;  ///< counts from 0 through the whole mission
  Time stamp = 0;
  SE3 T_odom_lidar = SE3::Identity();
  SE3 T_world_lidar = SE3::Identity();  ///< estimated
  Matrix6d covariance =
      Matrix6d::Constant(NAN);  ///< of the motion since the previous keyframe, right tangent
};

/// A pose that is known with an uncertainty: right tangent at `pose`.
struct PosePrior {
  SE3 pose = SE3::Identity();
  Matrix6d covariance = Matrix6d::Constant(NAN);
};

/// One flight's odometry in the graph. Observations name chains by their place among all.
struct Chain {
  std::vector<Keyframe>* keyframes = nullptr;     ///< ascending serial without gaps
  std::optional<PosePrior> prior = std::nullopt;  ///< of the first keyframe; without, it is held,
                                                  ///< and holds the frame
  std::size_t free_from = 0;  ///< keyframes before this one are held as they are
};
using Chains = std::span<const Chain>;

/// nullptr when it is no longer kept.
[[nodiscard]] const Keyframe* find(const std::vector<Keyframe>& keyframes, int serial);

/// The poses of the graph and the motion since the newest one.
class Trajectory {
 public:
  explicit Trajectory(const KeyframeConfig& config);

  /// Goes on to the next pose of odometry; true when it became a keyframe. A covariance that is not
  /// finite counts as the floor a hundredfold in standard deviation.
  bool advance(Time stamp, const SE3& T_odom_lidar, const Matrix6d& covariance);

  [[nodiscard]] const std::vector<Keyframe>& keyframes() const { return keyframes_; }
  [[nodiscard]] std::vector<Keyframe>& keyframes() { return keyframes_; }
  [[nodiscard]] const Keyframe& newest() const { return keyframes_.back(); }
  [[nodiscard]] const Keyframe* find(int serial) const { return slam::find(keyframes_, serial); }

  /// The keyframe that made room in the last step: what hangs on it is to be forgotten or fixed.
  [[nodiscard]] const std::optional<Keyframe>& retired() const { return retired_; }

  /// From the newest keyframe to the last pose of odometry, and its covariance.
  [[nodiscard]] const SE3& T_keyframe_lidar() const { return motion_; }
  [[nodiscard]] const Matrix6d& motion_covariance() const { return motion_covariance_; }

  [[nodiscard]] SE3 T_world_lidar() const { return newest().T_world_lidar * motion_; }
  [[nodiscard]] SE3 T_world_odom() const;
  [[nodiscard]] SE3 corrected(Time stamp, const SE3& T_odom_lidar) const;

 private:
  [[nodiscard]] bool far_enough(Time stamp) const;
  void add_keyframe(Time stamp, const SE3& T_odom_lidar);

  KeyframeConfig config_;
  std::vector<Keyframe> keyframes_;  ///< ascending serial and stamp
  std::optional<Keyframe> retired_;
  SE3 motion_ = SE3::Identity();
  Matrix6d motion_covariance_ = Matrix6d::Zero();
};

}  // namespace saker::slam
