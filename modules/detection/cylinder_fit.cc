#include "saker/detection/cylinder_fit.h"

#include <Eigen/Dense>
#include <cmath>

#include "saker/core/statistics.h"

namespace saker::detection {
namespace {

using Vector5d = Eigen::Matrix<double, 5, 1>;
using Matrix5d = Eigen::Matrix<double, 5, 5>;
using Points = std::vector<Eigen::Vector3d>;

constexpr double kThinnest = 0.01;  // m, of a radius

/// Radius from half the width across the line of sight, and the place behind the front.
struct Start {
  Vector5d state;
  double silhouette = 0;
  double silhouette_sd = 0;
};

/// Median place at each height, by a line fitted twice: z is much longer than the cylinder is wide.
Eigen::Vector2d offset_from(const Vector5d& state, const Eigen::Vector3d& p) {
  return p.head<2>() - state.head<2>() - state.segment<2>(2) * p.z();
}

double start_line(const Points& points, int k, double lean_sd, double* slope) {
  std::vector<double> values;
  std::vector<double> heights;
  for (const Eigen::Vector3d& p : points) {
    values.push_back(p[k]);
    heights.push_back(p.z());
  }
  const double mean_height = core::mean(heights);
  const double middle = core::median(values);
  double zz = std::pow(0.1 / lean_sd, 2);
  double zv = 0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    zz += (heights[i] - mean_height) * (heights[i] - mean_height);
    zv += (heights[i] - mean_height) * (values[i] - middle);
  }
  *slope = zv / zz;
  return middle - *slope * mean_height;
}

Start start(const Points& points, const Eigen::Vector3d& sensor, const CylinderFitConfig& config) {
  Start start;
  const double lean_sd = config.lean_sd_deg * M_PI / 180;
  start.state.setZero();
  for (int k = 0; k < 2; ++k) start.state[k] = start_line(points, k, lean_sd, &start.state[2 + k]);
  const Eigen::Vector2d sight = start.state.head<2>() - sensor.head<2>();
  const double range = std::max(sight.norm(), 0.1);
  const Eigen::Vector2d along = sight / range;
  std::vector<double> across;
  for (const Eigen::Vector3d& p : points) {
    const Eigen::Vector2d offset = offset_from(start.state, p);
    across.push_back(along.x() * offset.y() - along.y() * offset.x());
  }
  // The 10th and 90th percentile across a disc seen from one side lie at 0.8 of its radius.
  const double half = 0.5 * (core::percentile(across, 0.9) - core::percentile(across, 0.1)) / 0.8;
  start.silhouette = std::max(half, kThinnest);
  start.silhouette_sd =
      std::hypot(config.silhouette_sd * start.silhouette, 0.5 * config.spacing * range);
  start.state.head<2>() += 0.7 * start.silhouette * along;  // the points lie on the front
  start.state[4] = start.silhouette;
  return start;
}

struct Normal {
  Matrix5d H = Matrix5d::Zero();
  Vector5d g = Vector5d::Zero();
  double weight = 0;
  double squared = 0;
};

Normal linearise(const Points& points, const Vector5d& state, const CylinderFitConfig& config) {
  Normal normal;
  for (const Eigen::Vector3d& p : points) {
    const Eigen::Vector2d offset = offset_from(state, p);
    const double distance = offset.norm();
    if (distance < 1e-6) continue;
    const Eigen::Vector2d n = offset / distance;
    const double residual = distance - state[4];
    Vector5d row;
    row << -n, -n * p.z(), -1;
    const double weight = 1 / (1 + std::pow(residual / config.outlier_m, 2));
    normal.H += weight * row * row.transpose();
    normal.g += weight * residual * row;
    normal.weight += weight;
    normal.squared += weight * residual * residual;
  }
  return normal;
}

/// Points share errors: at most so many count as independent.
void scale(Normal& normal, double noise, const CylinderFitConfig& config) {
  const double shared = std::min(1.0, config.most_effective_points / std::max(normal.weight, 1.0));
  normal.H *= shared / (noise * noise);
  normal.g *= shared / (noise * noise);
}

void add_priors(Normal& normal, const Vector5d& state, const Start& start, double lean_sd) {
  for (int k = 2; k < 4; ++k) {
    normal.H(k, k) += std::pow(lean_sd, -2);
    normal.g[k] += state[k] * std::pow(lean_sd, -2);
  }
  normal.H(4, 4) += std::pow(start.silhouette_sd, -2);
  normal.g[4] += (state[4] - start.silhouette) * std::pow(start.silhouette_sd, -2);
}

}  // namespace

std::optional<CylinderFit> fit_cylinder(const Points& points, const Eigen::Vector3d& sensor,
                                        const CylinderFitConfig& config) {
  if (points.size() < 3) return std::nullopt;
  const Start first = start(points, sensor, config);
  const double lean_sd = config.lean_sd_deg * M_PI / 180;
  Vector5d state = first.state;
  Normal normal;
  double noise = config.noise_m;
  for (int i = 0; i <= config.iterations; ++i) {
    normal = linearise(points, state, config);
    if (normal.weight <= 0) return std::nullopt;
    noise = std::max(config.noise_m, std::sqrt(normal.squared / normal.weight));
    scale(normal, noise, config);
    add_priors(normal, state, first, lean_sd);
    if (i == config.iterations) break;
    state -= normal.H.ldlt().solve(normal.g);
    if (!state.allFinite()) return std::nullopt;
    state[4] = std::max(state[4], kThinnest);
  }
  CylinderFit fit;
  fit.foot = state.head<2>();
  fit.slope = state.segment<2>(2);
  fit.radius = state[4];
  fit.residual = std::sqrt(normal.squared / normal.weight);
  fit.covariance = normal.H.inverse();
  return fit;
}

}  // namespace saker::detection
