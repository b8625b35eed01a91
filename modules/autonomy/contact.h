#pragma once

#include "saker/core/config.h"
#include "saker/core/time.h"
#include "saker/lidar/scan.h"

/// Contact felt by the accelerometer — reads the inertial unit's samples, makes the stamp of the
/// last bump (for safety, which lands on it in flight).
///
/// A bump is a specific force that is far from the mean of the last `mean_s`: farther than
/// `least_mps2`, and than `margin` times the usual deviation of this vehicle (root mean square over
/// about `usual_s`: its vibration). In simulated flight the deviation is usually below 1 m/s² and
/// never more than 6; a bump of 1 m/s that ends within 30 ms makes 30. A touch that is softer is
/// not felt. Frame: any that is fixed to the body. Cost: nanoseconds a sample, no allocation.
namespace saker::autonomy {

struct ContactConfig {
  double least_mps2 = 18;
  double margin = 8;
  double mean_s = 0.2;
  double usual_s = 10;

  template <class Visitor>
  void visit(Visitor& v) {
    v.field("least_mps2", least_mps2, {1, 1000}, "m/s²",
            "from the mean: three times what flying makes");
    v.field("margin", margin, {1, 100}, "", "on the vehicle's usual deviation");
    v.field("mean_s", mean_s, {0.02, 5}, "s", "of the mean force");
    v.field("usual_s", usual_s, {1, 600}, "s", "of the usual deviation");
  }
};

class Contact {
 public:
  explicit Contact(const ContactConfig& config);  ///< throws Error on an invalid value

  /// In the order of time; a sample that is not finite or not newer is left out.
  /// \return whether it is a bump
  bool add(const lidar::ImuSample& sample);

  [[nodiscard]] Time last() const { return last_; }              ///< stamp of a bump; 0: none
  [[nodiscard]] double last_mps2() const { return last_mps2_; }  ///< from the mean; NaN: none
  [[nodiscard]] double most_mps2() const { return most_mps2_; }  ///< of all samples
  [[nodiscard]] double usual_mps2() const { return std::sqrt(square_); }

 private:
  ContactConfig config_;
  Time stamp_ = 0;
  Eigen::Vector3d mean_ = Eigen::Vector3d::Zero();
  double square_ = 0;  // (m/s²)², mean of the deviation's
  double most_mps2_ = 0;
  Time last_ = 0;
  double last_mps2_ = NAN;
};

}  // namespace saker::autonomy
