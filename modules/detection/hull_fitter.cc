#include "detection/hull_fitter.h"

#include <Eigen/Geometry>
#include <cmath>

#include "core/statistics.h"
#include "detection/hull.h"

namespace saker::detection {
namespace {

/// \param sd  m, of each edge
Extent percentiles_along(double direction, const Places& vertices, double sd,
                         const HullConfig& config) {
  const Eigen::Vector2d axis(std::cos(direction), std::sin(direction));
  std::vector<double> along;
  for (const Eigen::Vector2d& vertex : vertices) along.push_back(axis.dot(vertex));
  Extent extent;
  extent.low = core::percentile(along, config.low_percentile / 100);
  extent.high = core::percentile(along, config.high_percentile / 100);
  extent.covariance = of_centre_and_size(sd * sd * Eigen::Matrix2d::Identity());
  return extent;
}

}  // namespace

Plan HullFitter::fit(const VehicleView& view) const {
  const Places vertices = convex_hull(view.places);
  Plan plan;
  plan.heading = principal_direction(vertices);
  Eigen::Vector2d middle = Eigen::Vector2d::Zero();
  for (const Eigen::Vector2d& vertex : vertices) middle += vertex;
  middle /= static_cast<double>(vertices.size());
  const double sd =
      std::hypot(config_.edge_m, config_.edge_per_m * nearest_range(middle, view.sight));
  const auto along = [&](double direction) {
    return percentiles_along(direction, vertices, sd, config_);
  };
  plan.axis = {along(plan.heading), along(plan.heading + M_PI / 2)};
  if (plan.axis[0].size() < plan.axis[1].size()) {
    plan.heading += M_PI / 2;
    plan.axis = {along(plan.heading), along(plan.heading + M_PI / 2)};
  }
  plan.of_hits = plan.axis;
  plan.heading_sd = 0.7 * sd / std::max(plan.axis[0].size(), 0.5);  // an edge's error turns it
  return plan;
}

}  // namespace saker::detection
