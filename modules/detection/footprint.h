#pragma once

#include <Eigen/Core>
#include <array>
#include <string>
#include <vector>

#include "core/config.h"
#include "objects/models.h"

/// The rectangle of a vehicle on the ground plane.
///
/// Reads the places of its points on the plane; makes a direction and the extents along it and
/// across. Extents are percentiles over the vertices of the convex hull (paper, III-A), which
/// holds each side once however many points lie on it. The direction: `pca`, the first principal
/// component of the hull's vertices (paper), or `closeness`, the one under which most points lie
/// near a side (Zhang et al., "Efficient L-Shape Fitting for Vehicle Detection Using Laser
/// Scanners", IV 2017).
namespace saker::detection {

enum class AxisMethod { pca, closeness };

[[nodiscard]] inline std::vector<std::string> enum_names(AxisMethod) {
  return {"pca", "closeness"};
}

struct FootprintConfig {
  AxisMethod axis = AxisMethod::closeness;
  double low_percentile = 5;
  double high_percentile = 95;
  double side_m = 0.2;
  double step_deg = 1;

  template <class Visitor>
  void visit(Visitor& v) {
    v.field("axis", axis, "", "how the direction is found: pca (the paper's) or closeness");
    v.field("low_percentile", low_percentile, {0, 49}, "%",
            "of the hull's vertices along an axis: the lower edge (paper: 5)");
    v.field("high_percentile", high_percentile, {51, 100}, "%",
            "of the hull's vertices along an axis: the upper edge (paper: 95)");
    v.field("side_m", side_m, {0.01, 1}, "m",
            "closeness: nearer to a side than this counts as on it");
    v.field("step_deg", step_deg, {0.1, 10}, "deg", "closeness: step of the directions tried");
  }
};

struct Footprint {
  double direction = 0;                            ///< of the first axis, radians
  Eigen::Vector2d low = Eigen::Vector2d::Zero();   ///< lower edges along both axes, m
  Eigen::Vector2d high = Eigen::Vector2d::Zero();  ///< upper edges
  [[nodiscard]] Eigen::Vector2d size() const { return high - low; }
};

/// A box on the ground with its first two axes along a footprint's.
/// \param plan low and high corner along these axes
/// \param height above the ground, lower and upper end
[[nodiscard]] objects::Cuboid upright(double direction, const std::array<Eigen::Vector2d, 2>& plan,
                                      const std::array<double, 2>& height);

/// The first axis is the longer side. At least three points that are not in a line are expected;
/// of fewer the extents are what they are.
[[nodiscard]] Footprint fit_footprint(const std::vector<Eigen::Vector2d>& points,
                                      const FootprintConfig& config);

}  // namespace saker::detection
