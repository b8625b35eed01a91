#pragma once

#include "saker/core/config.h"
#include "saker/slam/model_algebra.h"

namespace saker::slam {

struct MeasurementNoiseConfig {
  double covariance_scale = 2;
  double lean_deg = 3;
  double roof_m = 0.3;
  double common_place_m = 0.03;
  double common_length_m = 0.03;
  double common_width_m = 0.03;
  double common_root = 0.13;
  double common_radius_m = 0.015;
  double common_taper = 0.12;
  double shared_place = 2.5;
  double shared_length = 3;
  double shared_width = 1;
  bool share_ends = true;
  double shared_end_per_m = 5;
  double fitted_end_sd_m = 0.28;
  double fitted_width_sd_m = 0.2;
  double shared_root = 4;
  double shared_radius = 80;
  double shared_radius_cells = 10;

  template <class Visitor>
  void visit(Visitor& v) {
    v.field(
        "covariance_scale", covariance_scale, {1, 100}, "",
        "windows of 1 s twice a second share half of their points: two of them say as much as one");
    v.field(
        "lean_deg", lean_deg, {0, 45}, "degree",
        "sd of a measured axis about the middle of what was seen: trunks taper and bend, so that "
        "each side leans its own way");
    v.field("roof_m", roof_m, {0, 5}, "m",
            "sd of a vehicle's top over its bottom: from afar the roof is not seen");
    v.field("common_place_m", common_place_m, {0, 10}, "m",
            "sd of a vehicle's place along each axis that no number of windows takes away; this "
            "and those to common_taper only widen the covariances that a map reports");
    v.field("common_length_m", common_length_m, {0, 10}, "m",
            "the same of its length: shapes that are no box");
    v.field("common_width_m", common_width_m, {0, 10}, "m", "the same of its width");
    v.field("common_root", common_root, {0, 1}, "",
            "the same of a cylinder's root along x and y, as a share of its radius: what stands "
            "about a trunk is taken for it; by the NEES of 60 missions");
    v.field("common_radius_m", common_radius_m, {0, 10}, "m",
            "the same of its radius: poles' NEES was 1.4 with 0.01 m (102 missions of saker)");
    v.field("common_taper", common_taper, {0, 1}, "",
            "and as a share of the radius: what tapers and is not round; by the NEES of 60 "
            "missions, as shared_radius and shared_radius_cells");
    v.field(
        "shared_place", shared_place, {1, 10000}, "",
        "windows that say as much of a vehicle's place as the graph believes of one: an end that "
        "no side shows is missed in all of them; by the NEES of eight flights");
    v.field("shared_length", shared_length, {1, 10000}, "", "the same of its length");
    v.field("shared_width", shared_width, {1, 10000}, "", "the same of its width");
    v.field("share_ends", share_ends, "",
            "whether windows share what they say wrongly of a vehicle's end");
    v.field("shared_end_per_m", shared_end_per_m, {0, 1000}, "1/m",
            "what windows share of a vehicle's end: this part of what the second best one states, "
            "at most all of it, for each metre stated; no end is known better. An end that some "
            "looked at erred by 0.3 of 0.08 m stated, one that none did by 0.6 to 1 of 0.12 m and "
            "more (36 missions of saker)");
    v.field("fitted_end_sd_m", fitted_end_sd_m, {0.01, 10}, "m",
            "standard deviation that a window states of a vehicle's end from which on the end is "
            "known no better; below by its square: stated to 0.1 m two thirds were within 0.04 m, "
            "to 0.14 m 0.07 m, to 0.2 m 0.14 m (36 missions of saker). An end is never better "
            "known than the fitted covariance has it");
    v.field("fitted_width_sd_m", fitted_width_sd_m, {0.01, 10}, "m",
            "standard deviation that windows state of a vehicle's width where they show both of "
            "its sides; of others the hidden side lies anywhere within what they state, so that "
            "many views of one side do not outvote a few of both");
    v.field("shared_root", shared_root, {1, 10000}, "",
            "windows that say as much of a trunk's or pole's root as the graph believes of one");
    v.field("shared_radius", shared_radius, {1, 10000}, "",
            "the same of its radius: what is round from one side seems round from all");
    v.field("shared_radius_cells", shared_radius_cells, {1, 10000}, "",
            "view cells that say as much of a radius as the graph believes of one, with fitted "
            "noise");
  }
};

/// A measurement with the errors that a fit to one window cannot see, for they are the same in
/// every window from one side. Taken for independent and small, they turn the robot: landmarks hand
/// the tilt on from one to the next (measured on flights: 0.4° and 0.5 m of height in 70 m).
///
/// A cylinder's axis turns about the middle of the part that was seen, so that its root moves with
/// it. A vehicle's height takes half of itself along to the centre; the bottom stays.
///
/// \param fitted the covariance is that of a fitted model, whose windows share their view cell:
/// then nothing is scaled, and an axis leans without its root, whose whole error the model knows.
[[nodiscard]] Gaussian with_common_errors(const Gaussian& measured,
                                          const MeasurementNoiseConfig& config,
                                          bool fitted = false);

/// Variances of what all measurements of one object share, 9 of a cuboid or 6 of a cylinder in the
/// order of its covariance: the object is no box and no cylinder, and parts of it stay hidden. The
/// graph cannot know them: they seem to be the object's own size and place.
[[nodiscard]] Eigen::VectorXd common_variances(const Model& model,
                                               const MeasurementNoiseConfig& config);

/// A cuboid's covariance once the class's widths are known to scatter by `sd` (m): Kalman's update
/// without what it moves, for a width that was not measured is the class's already, and one that
/// was is known far better. \param covariance 9×9
[[nodiscard]] Eigen::MatrixXd with_class_width(const Eigen::MatrixXd& covariance, double sd);

/// The graph takes every window for a measurement of its own (`slam.measurement_noise: fixed`), but
/// windows share most of their errors: what it says of an object's planar place and size is widened
/// by as many windows as count for one. Positive semi-definite as before.
/// \param covariance 9×9 of a cuboid or 6×6 of a cylinder
[[nodiscard]] Eigen::MatrixXd widened(const Model& model, const Eigen::MatrixXd& covariance,
                                      const MeasurementNoiseConfig& config);

}  // namespace saker::slam
