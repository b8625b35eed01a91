#pragma once

#include <Eigen/Core>

#include "saker/core/config.h"
#include "saker/core/rng.h"

namespace saker::simulation {

struct WindConfig {
  double mean_mps = 2.0;
  double towards_deg = 60;
  double gust_mps = 0.6;
  double gust_time_s = 3.0;

  template <class Visitor>
  void visit(Visitor& v) {
    v.field("mean_mps", mean_mps, {0, 20}, "m/s", "mean horizontal wind");
    v.field("towards_deg", towards_deg, {-360, 360}, "°", "where it blows to, from x about z");
    v.field("gust_mps", gust_mps, {0, 10}, "m/s", "sd of the gusts along x and y; half along z");
    v.field("gust_time_s", gust_time_s, {0.1, 60}, "s", "correlation time of the gusts");
  }
};

/// Wind at the vehicle, z up: a mean and gusts that are an Ornstein–Uhlenbeck process an axis
/// (first order Dryden: MIL-F-8785C, section 3.7.1, with the length scale divided by the mean
/// wind).
class Wind {
 public:
  Wind(const WindConfig& config, core::Rng rng);

  /// m/s. The gusts go on by `dt` seconds.
  [[nodiscard]] Eigen::Vector3d step(double dt);

  /// One gust on top of it from now on; the next one, or zero, ends it.
  void blow(const Eigen::Vector3d& gust) { extra_ = gust; }

 private:
  WindConfig config_;
  core::Rng rng_;
  Eigen::Vector3d mean_;
  Eigen::Vector3d gust_ = Eigen::Vector3d::Zero();
  Eigen::Vector3d extra_ = Eigen::Vector3d::Zero();
};

}  // namespace saker::simulation
