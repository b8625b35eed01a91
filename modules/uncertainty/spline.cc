#include "saker/uncertainty/spline.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

namespace saker::uncertainty {
namespace {

/// Slope at the node between two steps: their weighted harmonic mean, nil at an extremum.
double slope(double step_before, double rise_before, double step_after, double rise_after) {
  const double before = rise_before / step_before, after = rise_after / step_after;
  if (!(before * after > 0)) return 0;
  const double weight_before = 2 * step_after + step_before;
  const double weight_after = step_after + 2 * step_before;
  return (weight_before + weight_after) / (weight_before / before + weight_after / after);
}

/// Through four nodes, between the middle two.
Eigen::VectorXd between(const std::array<double, 4>& x, const std::array<Eigen::VectorXd, 4>& y,
                        double at) {
  const double h = x[2] - x[1];
  const double t = (at - x[1]) / h;
  const double from = (1 + 2 * t) * (1 - t) * (1 - t), slope_from = t * (1 - t) * (1 - t);
  const double to = t * t * (3 - 2 * t), slope_to = t * t * (t - 1);
  Eigen::VectorXd value(y[0].size());
  for (Eigen::Index i = 0; i < value.size(); ++i) {
    const double rise = y[2][i] - y[1][i];
    const double first = slope(x[1] - x[0], y[1][i] - y[0][i], h, rise);
    const double second = slope(h, rise, x[3] - x[2], y[3][i] - y[2][i]);
    value[i] = from * y[1][i] + to * y[2][i] + h * (slope_from * first + slope_to * second);
  }
  return value;
}

}  // namespace

SplineSurface::SplineSurface(Intervals intervals, std::vector<Eigen::VectorXd> nodes,
                             Eigen::VectorXd parity)
    : intervals_(std::move(intervals)), nodes_(std::move(nodes)), parity_(std::move(parity)) {}

Eigen::VectorXd SplineSurface::node(int range, int sector) const {
  const int count = intervals_.sectors;
  const bool outside = sector < 0 || sector >= count;
  const int reflected = sector < 0        ? -1 - sector
                        : sector >= count ? 2 * count - 1 - sector
                                          : sector;
  const auto i =
      static_cast<std::size_t>(intervals_.index(range, std::clamp(reflected, 0, count - 1)));
  return outside ? Eigen::VectorXd(nodes_[i].cwiseProduct(parity_)) : nodes_[i];
}

Eigen::VectorXd SplineSurface::along_angle(int range, double folded_angle) const {
  if (intervals_.sectors == 1) return node(range, 0);
  const double at = folded_angle * intervals_.sectors / std::numbers::pi - 0.5;  // in sectors
  const int left = static_cast<int>(std::floor(at));
  std::array<double, 4> x{};
  std::array<Eigen::VectorXd, 4> y;
  for (int i = 0; i < 4; ++i) {
    x[static_cast<std::size_t>(i)] = left - 1 + i;
    y[static_cast<std::size_t>(i)] = node(range, left - 1 + i);
  }
  return between(x, y, at);
}

Eigen::VectorXd SplineSurface::at(double range, double folded_angle) const {
  const int last = intervals_.ranges() - 1;
  if (range <= intervals_.range_centre(0)) return along_angle(0, folded_angle);
  if (range >= intervals_.range_centre(last)) return along_angle(last, folded_angle);
  int left = 0;
  while (range > intervals_.range_centre(left + 1)) ++left;
  std::array<double, 4> x{};
  std::array<Eigen::VectorXd, 4> y;
  for (int i = 0; i < 4; ++i) {
    const int inside = std::clamp(left - 1 + i, 0, last);
    x[static_cast<std::size_t>(i)] = intervals_.range_centre(inside);
    y[static_cast<std::size_t>(i)] = along_angle(inside, folded_angle);
  }
  if (left == 0) x[0] = 2 * x[1] - x[2];  // the constant beyond the ends
  if (left + 1 == last) x[3] = 2 * x[2] - x[1];
  return between(x, y, range);
}

}  // namespace saker::uncertainty
