#pragma once

#include <memory>
#include <string>
#include <vector>

#include "saker/core/config.h"
#include "saker/detection/face_fitter.h"
#include "saker/detection/gap.h"
#include "saker/detection/hull_fitter.h"
#include "saker/detection/motion.h"
#include "saker/detection/size_prior.h"
#include "saker/detection/vehicle_fitter.h"
#include "saker/objects/measurement.h"

/// The virtual sensor of vehicles: a cluster's points to a cuboid with covariance.
///
/// Reads points in the local ground's frame (z = 0 the ground), with the scan each came from, and
/// what their beams went through. Motion first, then the plan by a fitter (vehicle_fitter.h); the
/// top is a percentile of the heights. A cluster whose middle beams went through is more than one
/// vehicle. The lower end is the front (paper, IV-A).
namespace saker::detection {

enum class VehicleFitting { faces, hull };

[[nodiscard]] inline std::vector<std::string> enum_names(VehicleFitting) {
  return {"faces", "hull"};
}

/// Of what all fitters share.
struct VehicleNoiseConfig {
  double yaw_deg = 2;
  double tilt_deg = 2;
  double ground_m = 0.06;
  double top_m = 0.08;

  template <class Visitor>
  void visit(Visitor& v) {
    v.field("yaw_deg", yaw_deg, {0.01, 90}, "deg", "of the heading, both sides well seen");
    v.field("tilt_deg", tilt_deg, {0.01, 90}, "deg", "of the local ground's normal");
    v.field("ground_m", ground_m, {0.001, 2}, "m", "of the local ground's height");
    v.field("top_m", top_m, {0.001, 2}, "m", "of the top");
  }
};

struct VehicleConfig {
  VehicleFitting fitter = VehicleFitting::faces;
  double lowest_m = 0.2;
  double highest_m = 2.6;
  double top_percentile = 98;
  int least_points = 25;
  double least_length_m = 1.0;
  double least_height_m = 0.8;
  double most_length_m = 7.5;
  double most_width_m = 3.0;
  double thin_m = 0.05;
  double front_sd_m = 0.15;
  double most_front_log_odds = 3;
  FaceConfig faces;
  HullConfig hull;
  MotionConfig motion;
  GapConfig gap;
  VehicleNoiseConfig noise;

  template <class Visitor>
  void visit(Visitor& v) {
    v.field("fitter", fitter, "",
            "how the plan is found: faces (a density of each), or hull (paper)");
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
    v.field("thin_m", thin_m, {0.01, 0.5}, "m", "squares to which the points are thinned");
    v.field("front_sd_m", front_sd_m, {0.01, 2}, "m",
            "how far the ends' heights of one vehicle scatter: scale of the front's log-odds");
    v.field("most_front_log_odds", most_front_log_odds, {0, 20}, "", "of one measurement");
    v.group("faces", faces, "densities of the faces");
    v.group("hull", hull, "percentiles of the hull");
    v.group("motion", motion, "vehicles that move");
    v.group("gap", gap, "free space within");
    v.group("noise", noise, "standard deviations of a measurement");
  }
};

/// A point of a cluster in the local ground's frame.
struct BodyPoint {
  Eigen::Vector3f position;
  float seconds = 0;
};

/// `parted`: it is more than one thing, by its size or the beams that went through it.
enum class VehicleStatus { fitted, too_few, too_small, too_large, parted };

struct VehicleFit {
  VehicleStatus status = VehicleStatus::too_few;
  objects::Cuboid cuboid;  ///< local ground's frame
  Matrix9d covariance = Matrix9d::Constant(NAN);
  double front_log_odds = 0;
  Motion motion;
};

[[nodiscard]] std::unique_ptr<const VehicleFitter> make_fitter(const VehicleConfig& config,
                                                               const VehicleKinds& kinds);

[[nodiscard]] VehicleFit fit_vehicle(const std::vector<BodyPoint>& points, const Sight& sight,
                                     const VehicleFitter& fitter, const VehicleConfig& config,
                                     const VehicleKinds& kinds);

}  // namespace saker::detection
