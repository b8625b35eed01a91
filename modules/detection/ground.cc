#include "saker/detection/ground.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

namespace saker::detection {
namespace {

constexpr std::array kScales = {30.0, 8.0, 3.0, 1.0, 1.0};  // of the last one

/// Cauchy-weighted plane z = a x + b y + c, (a, b) with a Gaussian prior.
Eigen::Vector3d fit_plane(const std::vector<Eigen::Vector3d>& points, const Eigen::Vector2d& slope,
                          double slope_sd, const GroundConfig& config) {
  Eigen::Vector3d plane(slope.x(), slope.y(), 0);
  std::vector<double> heights;
  heights.reserve(points.size());
  for (const Eigen::Vector3d& p : points) heights.push_back(p.z() - slope.dot(p.head<2>()));
  std::nth_element(heights.begin(), heights.begin() + heights.size() / 2, heights.end());
  plane.z() = heights[heights.size() / 2];
  const double ridge = std::pow(config.noise_m / slope_sd, 2);
  for (const double scale : kScales) {
    Eigen::Matrix3d H = Eigen::Vector3d(ridge, ridge, 1e-9).asDiagonal();
    Eigen::Vector3d g(ridge * slope.x(), ridge * slope.y(), 0);
    for (const Eigen::Vector3d& p : points) {
      const Eigen::Vector3d row(p.x(), p.y(), 1);
      const double residual = (p.z() - row.dot(plane)) / (scale * config.outlier_m);
      const double weight = 1 / (1 + residual * residual);
      H += weight * row * row.transpose();
      g += weight * p.z() * row;
    }
    plane = H.ldlt().solve(g);
  }
  return plane;
}

}  // namespace

void Ground::fit(const std::vector<Eigen::Vector3f>& points,
                 const std::vector<ClassPoint>& vehicles, double range) {
  size_ = 2 * static_cast<int>(std::ceil(range / config_.cell_m));
  half_ = 0.5 * size_ * config_.cell_m;
  accumulate(points, vehicles);
  leave_out_bonnets();
  average_cells();
  cells_.assign(static_cast<std::size_t>(size_) * size_, std::nullopt);
  for (int row = 0; row < size_; ++row) {
    for (int column = 0; column < size_; ++column) {
      cells_[static_cast<std::size_t>(row) * size_ + column] = fit_cell(column, row);
    }
  }
  std::vector<std::size_t> refused;
  for (int row = 0; row < size_; ++row) {
    for (int column = 0; column < size_; ++column) {
      if (stands_off(column, row))
        refused.push_back(static_cast<std::size_t>(row) * size_ + column);
    }
  }
  for (const std::size_t i : refused) cells_[i].reset();
}

void Ground::accumulate(const std::vector<Eigen::Vector3f>& points,
                        const std::vector<ClassPoint>& vehicles) {
  const auto edge = static_cast<std::size_t>(size_ * config_.squares);
  squares_.assign(edge * edge, Square{});
  for (const Eigen::Vector3f& p : points) {
    Square* square = square_at(p);
    if (square == nullptr) continue;
    square->sum += p;
    ++square->count;
  }
  for (const ClassPoint& point : vehicles) {
    Square* square = square_at(point.position);
    if (square != nullptr) square->lowest = std::min(square->lowest, point.position.z());
  }
}

/// None outside of the grid.
Ground::Square* Ground::square_at(const Eigen::Vector3f& p) {
  const int edge = size_ * config_.squares;
  const auto per_m = static_cast<float>(config_.squares / config_.cell_m);
  const auto half = static_cast<float>(half_), rim = static_cast<float>(edge);
  const float column = (p.x() + half) * per_m;
  const float row = (p.y() + half) * per_m;
  if (!(column >= 0 && row >= 0 && column < rim && row < rim)) return nullptr;
  return &squares_[static_cast<std::size_t>(row) * edge + static_cast<std::size_t>(column)];
}

/// What was called ground, but lies over a vehicle.
void Ground::leave_out_bonnets() {
  const int edge = size_ * config_.squares;
  const auto most_over = static_cast<float>(config_.most_over_m);
  for (int row = 0; row < edge; ++row) {
    for (int column = 0; column < edge; ++column) {
      Square& square = squares_[static_cast<std::size_t>(row) * edge + column];
      if (square.count == 0) continue;
      const float height = square.sum.z() / static_cast<float>(square.count);
      if (height > lowest_about(column, row) + most_over) square.count = 0;
    }
  }
}

/// Of the vehicles' points in the square and its neighbours, m.
float Ground::lowest_about(int column, int row) const {
  const int edge = size_ * config_.squares;
  float lowest = std::numeric_limits<float>::infinity();
  for (int r = std::max(0, row - 1); r <= std::min(edge - 1, row + 1); ++r) {
    for (int c = std::max(0, column - 1); c <= std::min(edge - 1, column + 1); ++c) {
      lowest = std::min(lowest, squares_[static_cast<std::size_t>(r) * edge + c].lowest);
    }
  }
  return lowest;
}

/// Mean points of the squares in the cell and half a cell around it, relative to its centre.
const std::vector<Eigen::Vector3d>& Ground::support(int column, int row) {
  support_.clear();
  const int n = config_.squares;
  const int edge = size_ * n;
  const int margin = (n + 1) / 2;
  const Eigen::Vector2d middle = centre(column, row);
  for (int r = std::max(0, row * n - margin); r < std::min(edge, row * n + n + margin); ++r) {
    for (int c = std::max(0, column * n - margin); c < std::min(edge, column * n + n + margin);
         ++c) {
      const Square& square = squares_[static_cast<std::size_t>(r) * edge + c];
      if (square.count == 0) continue;
      Eigen::Vector3d mean = (square.sum / static_cast<float>(square.count)).cast<double>();
      mean.head<2>() -= middle;
      support_.push_back(mean);
    }
  }
  return support_;
}

void Ground::average_cells() {
  const int n = config_.squares, edge = size_ * n;
  means_.assign(static_cast<std::size_t>(size_) * size_, Eigen::Vector3d::Zero());
  std::vector<int> counts(means_.size(), 0);
  for (int row = 0; row < edge; ++row) {
    for (int column = 0; column < edge; ++column) {
      const Square& square = squares_[static_cast<std::size_t>(row) * edge + column];
      if (square.count == 0) continue;
      const std::size_t cell = static_cast<std::size_t>(row / n) * size_ + column / n;
      means_[cell] += (square.sum / static_cast<float>(square.count)).cast<double>();
      ++counts[cell];
    }
  }
  for (std::size_t i = 0; i < means_.size(); ++i) means_[i] /= counts[i];  // 0 / 0 is NaN
}

/// Of the plane through the mean points of the cells about this one, dz/dx and dz/dy.
Eigen::Vector2d Ground::slope_about(int column, int row) const {
  const int reach = static_cast<int>(std::round(config_.surroundings_m / config_.cell_m));
  const Eigen::Vector2d middle = centre(column, row);
  std::vector<Eigen::Vector3d> about;
  for (int r = std::max(0, row - reach); r <= std::min(size_ - 1, row + reach); ++r) {
    for (int c = std::max(0, column - reach); c <= std::min(size_ - 1, column + reach); ++c) {
      Eigen::Vector3d mean = means_[static_cast<std::size_t>(r) * size_ + c];
      if (!mean.allFinite()) continue;
      mean.head<2>() -= middle;
      about.push_back(mean);
    }
  }
  if (about.empty()) return Eigen::Vector2d::Zero();
  return fit_plane(about, Eigen::Vector2d::Zero(), config_.slope_sd, config_).head<2>();
}

std::optional<objects::GroundPlane> Ground::fit_cell(int column, int row) {
  const std::vector<Eigen::Vector3d>& seen = support(column, row);
  if (static_cast<int>(seen.size()) < config_.least_squares) return std::nullopt;
  const Eigen::Vector2d slope = slope_about(column, row);
  const Eigen::Vector3d plane = fit_plane(seen, slope, config_.bend_sd, config_);
  if (!plane.allFinite()) return std::nullopt;
  if (plane.head<2>().norm() > std::tan(config_.most_slope_deg * M_PI / 180)) return std::nullopt;
  const Eigen::Vector2d middle = centre(column, row);
  objects::GroundPlane ground;
  ground.normal = Eigen::Vector3d(-plane.x(), -plane.y(), 1).normalized();
  ground.point = Eigen::Vector3d(middle.x(), middle.y(), plane.z());
  ground.radius = config_.cell_m;
  return ground;
}

bool Ground::stands_off(int column, int row) const {
  const auto& own = cell(column, row);
  if (!own) return false;
  std::vector<double> heights;
  for (int r = std::max(0, row - 1); r <= std::min(size_ - 1, row + 1); ++r) {
    for (int c = std::max(0, column - 1); c <= std::min(size_ - 1, column + 1); ++c) {
      if ((r == row && c == column) || !cell(c, r)) continue;
      heights.push_back(cell(c, r)->height_of(own->point));
    }
  }
  if (heights.size() < 2) return false;
  std::nth_element(heights.begin(), heights.begin() + heights.size() / 2, heights.end());
  return std::abs(heights[heights.size() / 2]) > config_.most_step_m;
}

Eigen::Vector2d Ground::centre(int column, int row) const {
  return {(column + 0.5) * config_.cell_m - half_, (row + 0.5) * config_.cell_m - half_};
}

const objects::GroundPlane* Ground::at(const Eigen::Vector3d& p) const {
  if (!p.allFinite() || p.cwiseAbs().maxCoeff() > 1e6) return nullptr;
  const int column = static_cast<int>(std::floor((p.x() + half_) / config_.cell_m));
  const int row = static_cast<int>(std::floor((p.y() + half_) / config_.cell_m));
  const bool inside = column >= 0 && row >= 0 && column < size_ && row < size_;
  if (inside && cell(column, row)) return &*cell(column, row);
  const int reach = static_cast<int>(std::ceil(config_.reach_m / config_.cell_m));
  const objects::GroundPlane* best = nullptr;
  double best_distance = config_.reach_m + config_.cell_m / 2;
  for (int r = std::max(0, row - reach); r <= std::min(size_ - 1, row + reach); ++r) {
    for (int c = std::max(0, column - reach); c <= std::min(size_ - 1, column + reach); ++c) {
      const double distance = (centre(c, r) - p.head<2>()).norm();
      if (!cell(c, r) || distance >= best_distance) continue;
      best_distance = distance;
      best = &*cell(c, r);
    }
  }
  return best;
}

std::vector<objects::GroundPlane> Ground::planes() const {
  std::vector<objects::GroundPlane> planes;
  for (const auto& plane : cells_) {
    if (plane) planes.push_back(*plane);
  }
  return planes;
}

}  // namespace saker::detection
