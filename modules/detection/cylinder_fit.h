#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "saker/core/config.h"
#include "saker/core/se3.h"

/// A trunk's or pole's cylinder, after Chen et al., "SLOAM", RA-L 2020 (III-B).
///
/// Reads a cluster's points in a local ground frame (z = 0 is the ground, z up); makes the axis,
/// as place at z = 0 and slope, and the radius, by reweighted Gauss-Newton on the distance to the
/// surface. Few beams see a narrow arc of the front, from which alone a radius is poorly known:
/// the width of the silhouette, seen across the line of sight, is a second measurement of it.
namespace saker::detection {

struct CylinderFitConfig {
  double noise_m = 0.02;
  double outlier_m = 0.05;
  double lean_sd_deg = 6;
  double silhouette_sd = 0.3;
  double spacing = 0.006;
  int iterations = 12;
  double most_effective_points = 60;

  template <class Visitor>
  void visit(Visitor& v) {
    v.field("noise_m", noise_m, {0.001, 0.5}, "m",
            "standard deviation of a point off the surface: range noise and bark");
    v.field("outlier_m", outlier_m, {0.005, 1}, "m", "scale of the Cauchy weight");
    v.field("lean_sd_deg", lean_sd_deg, {0.1, 60}, "deg",
            "prior of the axis against the vertical; holds the slope of a short piece");
    v.field("silhouette_sd", silhouette_sd, {0.01, 2}, "",
            "of the radius taken from the silhouette's width, relative");
    v.field("spacing", spacing, {0, 0.05}, "rad",
            "angle between neighbouring beams: by half of it the silhouette is uncertain");
    v.field("iterations", iterations, {1, 100}, "", "of Gauss-Newton");
    v.field(
        "most_effective_points", most_effective_points, {3, 100000}, "points",
        "more points do not sharpen the fit: their errors are common (bark, pose, calibration)");
  }
};

struct CylinderFit {
  Eigen::Vector2d foot = Eigen::Vector2d::Zero();   ///< axis at z = 0, m
  Eigen::Vector2d slope = Eigen::Vector2d::Zero();  ///< axis ∝ (slope, 1)
  double radius = 0;
  double residual = 0;  ///< root mean square distance of the points to the surface, weighted, m
  Eigen::Matrix<double, 5, 5> covariance;  ///< [foot, slope, radius]
};

/// \param sensor where the points were seen from, in their frame
[[nodiscard]] std::optional<CylinderFit> fit_cylinder(const std::vector<Eigen::Vector3d>& points,
                                                      const Eigen::Vector3d& sensor,
                                                      const CylinderFitConfig& config);

}  // namespace saker::detection
