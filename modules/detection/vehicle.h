#pragma once

#include <optional>
#include <vector>

#include "core/config.h"
#include "detection/footprint.h"
#include "detection/interval.h"
#include "detection/motion.h"
#include "objects/measurement.h"

/// The virtual sensor of vehicles: a cluster's points to a cuboid with covariance.
///
/// Reads points in the local ground's frame (z = 0 the ground), with the scan each came from, and
/// where the scans were taken. Motion, footprint (footprint.h), then the edges: one whose face, or
/// a face beside it, or the roof was looked at is measured; one that was not is only a bound, and
/// the class's size says where it likely is, with a covariance that says so (interval.h). The
/// lower end is the front (paper, III-A).
namespace saker::detection {

struct VehicleNoiseConfig {
  double edge_m = 0.08;
  double edge_per_m = 0.003;
  double unseen_m = 1.0;
  double glancing_deg = 4;
  double clear_deg = 12;
  double yaw_deg = 2;
  double tilt_deg = 2;
  double ground_m = 0.06;
  double top_m = 0.08;

  template <class Visitor>
  void visit(Visitor& v) {
    v.field("edge_m", edge_m, {0.001, 2}, "m", "standard deviation of an edge that was seen");
    v.field("edge_per_m", edge_per_m, {0, 0.1}, "m/m",
            "more of it by range: half the spacing of beams");
    v.field("unseen_m", unseen_m, {0.1, 10}, "m",
            "standard deviation of an edge that was not seen");
    v.field("glancing_deg", glancing_deg, {0, 90}, "deg",
            "a face seen under a smaller angle is not seen");
    v.field("clear_deg", clear_deg, {0, 90}, "deg", "a face seen under a larger angle is seen");
    v.field("yaw_deg", yaw_deg, {0.01, 90}, "deg", "of the heading, both sides well seen");
    v.field("tilt_deg", tilt_deg, {0.01, 90}, "deg", "of the local ground's normal");
    v.field("ground_m", ground_m, {0.001, 2}, "m", "of the local ground's height");
    v.field("top_m", top_m, {0.001, 2}, "m", "of the top");
  }
};

struct VehicleConfig {
  double lowest_m = 0.2;
  double highest_m = 2.6;
  double top_percentile = 98;
  int least_points = 25;
  double least_length_m = 1.0;
  double least_height_m = 0.8;
  double most_length_m = 7.5;
  double most_width_m = 3.0;
  double length_m = 4.4;
  double length_sd_m = 0.45;
  double width_m = 1.8;
  double width_sd_m = 0.12;
  double thin_m = 0.05;
  double front_sd_m = 0.15;
  double most_front_log_odds = 3;
  FootprintConfig footprint;
  MotionConfig motion;
  VehicleNoiseConfig noise;

  template <class Visitor>
  void visit(Visitor& v) {
    v.field("lowest_m", lowest_m, {-1, 2}, "m",
            "lower end of the elevation window above the local ground: leaves the road out");
    v.field("highest_m", highest_m, {0.5, 10}, "m", "its upper end: leaves branches out");
    v.field("top_percentile", top_percentile, {50, 100}, "%", "of the points' heights: the top");
    v.field("least_points", least_points, {5, 100000}, "points", "fewer are no vehicle");
    v.field("least_length_m", least_length_m, {0.1, 10}, "m",
            "a cluster whose longer side is shorter is refused");
    v.field("least_height_m", least_height_m, {0.1, 10}, "m", "a lower one is refused");
    v.field("most_length_m", most_length_m, {1, 50}, "m", "a longer one is split, else refused");
    v.field("most_width_m", most_width_m, {1, 50}, "m", "a wider one is split, else refused");
    v.field("length_m", length_m, {1, 20}, "m", "mean length of the class, for unseen ends");
    v.field("length_sd_m", length_sd_m, {0.01, 10}, "m", "its standard deviation");
    v.field("width_m", width_m, {0.5, 5}, "m", "mean width of the class, for unseen sides");
    v.field("width_sd_m", width_sd_m, {0.01, 5}, "m", "its standard deviation");
    v.field("thin_m", thin_m, {0.01, 0.5}, "m",
            "squares to which the footprint's points are thinned");
    v.field("front_sd_m", front_sd_m, {0.01, 2}, "m",
            "how far the ends' heights of one vehicle scatter: scale of the front's log-odds");
    v.field("most_front_log_odds", most_front_log_odds, {0, 20}, "", "of one measurement");
    v.group("footprint", footprint, "rectangle on the ground");
    v.group("motion", motion, "vehicles that move");
    v.group("noise", noise, "standard deviations of a measurement");
  }
};

/// A point of a cluster in the local ground's frame.
struct BodyPoint {
  Eigen::Vector3f position;
  float seconds = 0;
};

enum class VehicleStatus { fitted, too_few, too_small, too_large };

struct VehicleFit {
  VehicleStatus status = VehicleStatus::too_few;
  objects::Cuboid cuboid;  ///< local ground's frame
  Matrix9d covariance = Matrix9d::Constant(NAN);
  double front_log_odds = 0;
  Motion motion;
};

/// \param sensors where the scans were taken, in the frame of the points
[[nodiscard]] VehicleFit fit_vehicle(const std::vector<BodyPoint>& points,
                                     const std::vector<Eigen::Vector3d>& sensors,
                                     const VehicleConfig& config);

}  // namespace saker::detection
