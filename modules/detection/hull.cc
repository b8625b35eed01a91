#include "saker/detection/hull.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

namespace saker::detection {
namespace {

double turn(const Eigen::Vector2d& a, const Eigen::Vector2d& b, const Eigen::Vector2d& c) {
  return (b.x() - a.x()) * (c.y() - a.y()) - (b.y() - a.y()) * (c.x() - a.x());
}

void extend(std::vector<Eigen::Vector2d>& hull, std::size_t fixed, const Eigen::Vector2d& p) {
  while (hull.size() >= fixed + 2 && turn(hull[hull.size() - 2], hull.back(), p) <= 0) {
    hull.pop_back();
  }
  hull.push_back(p);
}

}  // namespace

std::vector<Eigen::Vector2d> convex_hull(std::vector<Eigen::Vector2d> points) {
  std::sort(points.begin(), points.end(), [](const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
    return a.x() < b.x() || (a.x() == b.x() && a.y() < b.y());
  });
  points.erase(std::unique(points.begin(), points.end()), points.end());
  if (points.size() < 3) return points;
  std::vector<Eigen::Vector2d> hull;
  for (const Eigen::Vector2d& p : points) extend(hull, 0, p);
  const std::size_t lower = hull.size() - 1;
  for (auto p = points.rbegin() + 1; p != points.rend(); ++p) extend(hull, lower, *p);
  hull.pop_back();
  return hull;
}

double principal_direction(const std::vector<Eigen::Vector2d>& points) {
  if (points.size() < 2) return 0;
  Eigen::Vector2d mean = Eigen::Vector2d::Zero();
  for (const Eigen::Vector2d& p : points) mean += p / static_cast<double>(points.size());
  Eigen::Matrix2d scatter = Eigen::Matrix2d::Zero();
  for (const Eigen::Vector2d& p : points) scatter += (p - mean) * (p - mean).transpose();
  return 0.5 * std::atan2(2 * scatter(0, 1), scatter(0, 0) - scatter(1, 1));
}

}  // namespace saker::detection
