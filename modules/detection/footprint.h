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
/// across, in one of two ways. `sides`: the direction is the one under which most points lie near a
/// side (Zhang et al., "Efficient L-Shape Fitting for Vehicle Detection Using Laser Scanners", IV
/// 2017); a side lies where most strips across it reach to, so that what stands out of a few of
/// them, as a wing mirror does, or stays back, as a rounded corner, does not move it. What reaches
/// farther than any strips that lie together is no side: sparse leaves of a bush that touches it,
/// each somewhere else, would move the percentile from a quarter of the strips on. A dense bush,
/// whose strips reach equally far, is a side as well. `hull`: the
/// paper's (III-A), the first principal component of the convex hull's vertices and percentiles
/// over them; the hull has few vertices on a straight side, and a mirror is one of them.
namespace saker::detection {

enum class FootprintMethod { sides, hull };

[[nodiscard]] inline std::vector<std::string> enum_names(FootprintMethod) {
  return {"sides", "hull"};
}

struct FootprintConfig {
  FootprintMethod method = FootprintMethod::sides;
  double strip_m = 0.25;
  double layer_m = 0.06;
  double reach_percentile = 75;
  double outer_percentile = 95;
  double together_m = 0.2;
  double together_share = 0.3;
  double stands_out_m = 0.15;
  double looked_at = 0.5;
  double side_m = 0.1;
  double step_deg = 1;
  double low_percentile = 5;
  double high_percentile = 95;

  template <class Visitor>
  void visit(Visitor& v) {
    v.field("method", method, "", "how the rectangle is found: sides, or hull (the paper's)");
    v.field("strip_m", strip_m, {0.05, 2}, "m",
            "sides: strips across a side, wider than beams are apart, a mirror within one or two");
    v.field("layer_m", layer_m, {0, 1}, "m",
            "sides: within a strip's outermost place: on one face, whose place is their mean; four "
            "sds of a range's noise. The outermost alone lies 0.02 to 0.03 m too far out");
    v.field(
        "reach_percentile", reach_percentile, {50, 100}, "%",
        "sides: of how far the strips reach outward: the side; a quarter of them may stand out");
    v.field("outer_percentile", outer_percentile, {50, 100}, "%",
            "sides: the same of what stands out farthest, alone or not: all that is seen of a side "
            "from behind");
    v.field(
        "together_m", together_m, {0.01, 1}, "m",
        "sides: strips that reach equally far: a bumper's curve is within, leaves scatter more");
    v.field("together_share", together_share, {0, 1}, "",
            "sides: of the strips that do so: a side; what reaches farther is none. Leaves of a "
            "bush rarely are so many, a side whose half is hidden is");
    v.field("stands_out_m", stands_out_m, {0, 5}, "m",
            "sides: of a face that was looked at: not the vehicle's, and once left out the "
            "direction is found again");
    v.field("looked_at", looked_at, {0, 1}, "",
            "sides: above which a face counts as looked at: a sensor half of setback.outside_m "
            "outside of its plane");
    v.field("side_m", side_m, {0.01, 1}, "m",
            "sides: nearer to a side than this counts as on it: doors and wheels, noise and drift");
    v.field("step_deg", step_deg, {0.1, 10}, "deg", "sides: step of the directions tried");
    v.field("low_percentile", low_percentile, {0, 49}, "%",
            "hull: of its vertices along an axis: the lower edge (paper: 5)");
    v.field("high_percentile", high_percentile, {51, 100}, "%",
            "hull: of its vertices along an axis: the upper edge (paper: 95)");
  }
};

struct Footprint {
  double direction = 0;                            ///< of the first axis, radians
  Eigen::Vector2d low = Eigen::Vector2d::Zero();   ///< lower edges along both axes, m
  Eigen::Vector2d high = Eigen::Vector2d::Zero();  ///< upper edges
  Eigen::Vector2d outer_low = low;                 ///< what stands out farthest, there
  Eigen::Vector2d outer_high = high;
  [[nodiscard]] Eigen::Vector2d size() const { return high - low; }
};

/// The same rectangle with its second axis first: a quarter turn.
[[nodiscard]] Footprint turned(const Footprint& footprint);

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
