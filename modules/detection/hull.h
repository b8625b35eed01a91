#pragma once

#include <Eigen/Core>
#include <vector>

namespace saker::detection {

/// Convex hull, counter-clockwise, without collinear vertices (Andrew's monotone chain). Fewer than
/// three points, or all in a line: the distinct ends.
[[nodiscard]] std::vector<Eigen::Vector2d> convex_hull(std::vector<Eigen::Vector2d> points);

/// First principal component of the points, radians; 0 for fewer than two.
[[nodiscard]] double principal_direction(const std::vector<Eigen::Vector2d>& points);

}  // namespace saker::detection
