#pragma once

#include <array>
#include <cmath>
#include <cstddef>

#include "saker/core/config.h"
#include "saker/core/se3.h"
#include "saker/lidar/scan.h"

namespace saker::autonomy {

struct ContactConfig {
  double window_s = 0.06;
  double steady_s = 0.5;
  double sideways_mps2 = 6;
  double upwards_mps2 = 40;
  double downwards_mps2 = 5;

  template <class Visitor>
  void visit(Visitor& v) {
    v.field("window_s", window_s, {0.05, 1}, "s",
            "the force is a mean over so long: 6 samples at 100 Hz; vibration has none");
    v.field("steady_s", steady_s, {0.1, 10}, "s",
            "what lasts longer is wind, a bias or a tilt of the mount");
    v.field("sideways_mps2", sideways_mps2, {1, 200}, "m/s²",
            "beyond the steady one: rotors push along their axis, a gust of 15 m/s gives 4.5; who "
            "loses 0.5 m/s at a wall within the window feels 8");
    v.field("upwards_mps2", upwards_mps2, {10, 400}, "m/s²",
            "along the rotors' axis: 4 g, more than rotors give");
    v.field("downwards_mps2", downwards_mps2, {1, 200}, "m/s²",
            "against it: rotors do not push downwards");
  }
};

/// What was felt last.
struct Contact {
  Time stamp = 0;           ///< 0: nothing yet
  double force_mps2 = NAN;  ///< of the mean over the window, beyond what flight explains
};

/// Contact by the accelerometer — reads the IMU's samples, makes what was felt last (for safety).
///
/// Frames: samples are the lidar's; forces are the body's, z along the rotors. A multirotor's
/// specific force sideways is drag alone, whatever it flies: thrust is along z. The mean over some
/// samples, less the one that is farthest off (a broken reading is no contact), less what turning
/// does at the lever of the mount, is held against what was steady before and against what rotors
/// can give. Not told from a contact: a touch-down; who lands does not ask. No clock; allocates
/// nothing. Cost: a pass over the window a sample.
class ContactSense {
 public:
  /// Throws Error on an invalid value.
  ContactSense(const ContactConfig& config, const SE3& T_body_lidar);

  /// In the order of time; what is not newer or not finite is left out. A gap as long as the window
  /// begins anew.
  void add(const lidar::ImuSample& sample);

  [[nodiscard]] const Contact& last() const { return last_; }

 private:
  static constexpr std::size_t kMost = 256;  // samples in a window: 4 kHz
  static constexpr std::size_t kLeast = 4;
  struct Reading {
    Time stamp = 0;
    Eigen::Vector3d force = Eigen::Vector3d::Zero();  // m/s², body
    Eigen::Vector3d rate = Eigen::Vector3d::Zero();   // rad/s, body
  };

  [[nodiscard]] const Reading& at(std::size_t i) const { return ring_[(first_ + i) % kMost]; }
  void drop_before(Time oldest);
  void settle(const Reading& old);
  [[nodiscard]] Eigen::Vector3d mean_force() const;
  [[nodiscard]] Eigen::Vector3d of_turning() const;
  void judge();

  ContactConfig config_;
  Eigen::Matrix3d R_body_lidar_;
  Eigen::Vector3d lever_;
  std::array<Reading, kMost> ring_;  // of the window
  std::size_t first_ = 0, count_ = 0;
  Eigen::Vector3d steady_ = Eigen::Vector3d::Zero();  // before the window
  double steady_weight_ = 0;                          // 0: none yet … 1
  Time settled_ = 0;
  Contact last_;
};

}  // namespace saker::autonomy
