#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "saker/core/config.h"

/// Whether a cluster moves: the velocity under which its scans fall on each other.
///
/// Points of something that moves smear along its path: seen from above, they cover more squares
/// than they do once each scan is moved back by velocity × time. Velocities along the cluster's
/// long and short direction are tried; something parked covers fewest squares at rest, whatever
/// part of it is seen when. Cost: velocities × (thinned) points.
namespace saker::detection {

struct MotionConfig {
  double square_m = 0.2;
  double fastest = 25;
  double step = 0.5;
  double slowest = 1;
  double least_gain = 0.25;
  double least_seconds = 0.25;
  int most_points = 1000;

  template <class Visitor>
  void visit(Visitor& v) {
    v.field("square_m", square_m, {0.05, 2}, "m", "edge of the squares that are counted");
    v.field("fastest", fastest, {1, 100}, "m/s", "highest speed tried");
    v.field("step", step, {0.05, 5}, "m/s", "step of the speeds tried");
    v.field("slowest", slowest, {0.1, 10}, "m/s",
            "slower is parked: within a second it cannot be told from a change of view");
    v.field("least_gain", least_gain, {0.01, 0.9}, "",
            "part of the squares that must be saved by moving before a cluster counts as moving");
    v.field("least_seconds", least_seconds, {0.01, 10}, "s",
            "time that the cluster's points must span to say anything");
    v.field("most_points", most_points, {50, 100000}, "points",
            "points of a cluster used, taken evenly");
  }
};

struct TimedPoint {
  Eigen::Vector2f position;
  float seconds = 0;  ///< relative to the last scan, ≤ 0
};

struct Motion {
  bool moving = false;
  Eigen::Vector2d velocity = Eigen::Vector2d::Zero();  ///< m/s; zero where not moving
};

/// \param direction of the cluster's long side, radians
[[nodiscard]] Motion estimate_motion(std::span<const TimedPoint> points, double direction,
                                     const MotionConfig& config);

}  // namespace saker::detection
