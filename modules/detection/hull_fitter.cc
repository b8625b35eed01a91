#include "saker/detection/hull_fitter.h"

#include <Eigen/Geometry>
#include <cmath>

#include "saker/core/statistics.h"
#include "saker/detection/hull.h"

namespace saker::detection {
namespace {

Extent percentiles_along(double direction, const Places& vertices, const HullConfig& config) {
  const Eigen::Vector2d axis(std::cos(direction), std::sin(direction));
  std::vector<double> along;
  for (const Eigen::Vector2d& vertex : vertices) along.push_back(axis.dot(vertex));
  return {core::percentile(along, config.low_percentile / 100),
          core::percentile(along, config.high_percentile / 100)};
}

}  // namespace

Plan HullFitter::outline(const VehicleView& view) const {
  const Places vertices = convex_hull(view.places);
  const auto plan_along = [&](double heading) {
    return Plan{heading,
                0,
                {percentiles_along(heading, vertices, config_),
                 percentiles_along(heading + M_PI / 2, vertices, config_)}};
  };
  const Plan plan = plan_along(principal_direction(vertices));
  const bool lengthwise = plan.axis[0].size() >= plan.axis[1].size();
  return lengthwise ? plan : plan_along(plan.heading + M_PI / 2);
}

Plan HullFitter::fit(const VehicleView& view, const Plan& outline) const {
  Plan plan = outline;
  const Eigen::Vector2d middle = Eigen::Rotation2Dd(plan.heading) *
                                 Eigen::Vector2d(plan.axis[0].centre(), plan.axis[1].centre());
  const double sd =
      std::hypot(config_.edge_m, config_.edge_per_m * nearest_range(middle, view.sight));
  for (Extent& extent : plan.axis) {
    extent.covariance = of_centre_and_size(sd * sd * Eigen::Matrix2d::Identity());
  }
  plan.heading_sd = 0.7 * sd / std::max(plan.axis[0].size(), 0.5);  // an edge's error turns it
  return plan;
}

}  // namespace saker::detection
