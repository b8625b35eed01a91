#include "saker/odometry/column_search.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <queue>
#include <utility>

namespace saker::odometry {
namespace {

constexpr int kLevels = 6;  // windows of 1 to 32 cells
constexpr int kApart = 3;   // cells between starts
constexpr std::uint8_t kIn = 2, kBeside = 1;

using Cell = Eigen::Vector2i;

Cell cell_of(const Eigen::Vector2d& at, double cell_m) {
  return (at / cell_m).array().floor().cast<int>();
}

/// For each window of 2^level cells, by its lowest cell, the best that a column can find in it.
class Windows {
 public:
  Windows(const std::vector<Eigen::Vector2d>& columns, double cell_m) {
    Cell low = cell_of(columns.front(), cell_m), high = low;
    for (const Eigen::Vector2d& column : columns) {
      low = low.cwiseMin(cell_of(column, cell_m));
      high = high.cwiseMax(cell_of(column, cell_m));
    }
    const int margin = 1 << (kLevels - 1);
    low_ = low.array() - margin - 1;
    size_ = (high - low_).array() + 2;
    for (std::vector<std::uint8_t>& level : levels_)
      level.assign(static_cast<std::size_t>(size_.x()) * static_cast<std::size_t>(size_.y()), 0);
    for (const Eigen::Vector2d& column : columns) draw(cell_of(column, cell_m));
    for (int level = 1; level < kLevels; ++level) widen(level);
  }

  [[nodiscard]] std::uint8_t best(int level, const Cell& cell) const {
    const Cell at = cell - low_;
    if (at.minCoeff() < 0 || at.x() >= size_.x() || at.y() >= size_.y()) return 0;
    return levels_[static_cast<std::size_t>(level)][index(at)];
  }

 private:
  [[nodiscard]] std::size_t index(const Cell& at) const {
    return static_cast<std::size_t>(at.y()) * static_cast<std::size_t>(size_.x()) +
           static_cast<std::size_t>(at.x());
  }

  void draw(const Cell& column) {
    for (int y = -1; y <= 1; ++y)
      for (int x = -1; x <= 1; ++x) {
        std::uint8_t& value = levels_[0][index(column - low_ + Cell(x, y))];
        value = std::max(value, x == 0 && y == 0 ? kIn : kBeside);
      }
  }

  /// A window is four of half its width.
  void widen(int level) {
    const int half = 1 << (level - 1);
    for (int y = 0; y < size_.y(); ++y)
      for (int x = 0; x < size_.x(); ++x) {
        std::uint8_t most = 0;
        for (const Cell& to : {Cell(0, 0), Cell(half, 0), Cell(0, half), Cell(half, half)})
          most = std::max(most, best(level - 1, low_ + Cell(x, y) + to));
        levels_[static_cast<std::size_t>(level)][index(Cell(x, y))] = most;
      }
  }

  Cell low_, size_;
  std::array<std::vector<std::uint8_t>, kLevels> levels_;
};

/// Where points or voxels stand above one another, one place a cell: the mean.
class Columns {
 public:
  explicit Columns(double cell_m) : cell_m_(cell_m) {}

  void add(const Eigen::Vector3d& p) { stack_.push_back({cell_of(p.head<2>(), cell_m_), p}); }

  /// Of those that are so high.
  [[nodiscard]] std::vector<Eigen::Vector2d> places(double height_m) {
    std::sort(stack_.begin(), stack_.end(), [](const Item& a, const Item& b) {
      return std::pair(a.cell.x(), a.cell.y()) < std::pair(b.cell.x(), b.cell.y());
    });
    std::vector<Eigen::Vector2d> places;
    for (std::size_t i = 0, next; i < stack_.size(); i = next) {
      Eigen::Vector2d sum = Eigen::Vector2d::Zero();
      double low = stack_[i].point.z(), high = low;
      for (next = i; next < stack_.size() && stack_[next].cell == stack_[i].cell; ++next) {
        sum += stack_[next].point.head<2>();
        low = std::min(low, stack_[next].point.z());
        high = std::max(high, stack_[next].point.z());
      }
      if (high - low >= height_m) places.push_back(sum / static_cast<double>(next - i));
    }
    return places;
  }

 private:
  struct Item {
    Cell cell;
    Eigen::Vector3d point;
  };

  double cell_m_;
  std::vector<Item> stack_;
};

/// Moved by `shift` cells and all that its window holds, turned by one of the angles.
struct Node {
  int bound = 0;
  int level = 0;
  int angle = 0;
  Cell shift = Cell::Zero();

  /// Deeper first among equals.
  bool operator<(const Node& other) const {
    return bound != other.bound ? bound < other.bound : level > other.level;
  }
};

/// The scan's columns at one heading, in cells.
struct Turned {
  double radians = 0;
  std::vector<Cell> cells;

  [[nodiscard]] int score(const Windows& windows, int level, const Cell& shift) const {
    int sum = 0;
    for (const Cell& cell : cells) sum += windows.best(level, cell + shift);
    return sum;
  }
};

std::vector<Eigen::Vector2d> every_nth(const std::vector<Eigen::Vector2d>& places, int about) {
  const auto most = static_cast<std::size_t>(about);
  const std::size_t stride = std::max<std::size_t>(1, (places.size() + most - 1) / most);
  std::vector<Eigen::Vector2d> some;
  for (std::size_t i = 0; i < places.size(); i += stride) some.push_back(places[i]);
  return some;
}

double rms(const std::vector<Eigen::Vector2d>& places) {
  double sum = 0;
  for (const Eigen::Vector2d& place : places) sum += place.squaredNorm();
  return std::sqrt(sum / static_cast<double>(places.size()));
}

std::vector<Turned> turned(const std::vector<Eigen::Vector2d>& places, const SE3& T, double reach,
                           double cell_m) {
  const double step = cell_m / std::max(rms(places), cell_m);
  const int half = static_cast<int>(std::ceil(reach / step));
  std::vector<Turned> all;
  for (int k = -half; k <= half; ++k) {
    Turned& one = all.emplace_back();
    one.radians = k * step;
    const Eigen::Rotation2Dd R(one.radians);
    for (const Eigen::Vector2d& place : places)
      one.cells.push_back(cell_of(R * place + T.translation().head<2>(), cell_m));
  }
  return all;
}

/// What the prior leaves open in the horizontal.
struct Reach {
  double place_m = 0;
  double heading_rad = 0;
};

Reach reach_of(const PosePrior& prior, const ColumnSearchConfig& config) {
  const Eigen::Matrix3d R = prior.T_odom_lidar.linear();
  const Eigen::Matrix3d turn = R * prior.covariance.topLeftCorner<3, 3>() * R.transpose();
  const Eigen::Matrix3d place = R * prior.covariance.bottomRightCorner<3, 3>() * R.transpose();
  const double sd_m = std::sqrt(std::max(place(0, 0), place(1, 1)));
  return {std::min(config.reach_sd * sd_m, config.most_m),
          std::min(config.reach_sd * std::sqrt(turn(2, 2)), M_PI)};
}

/// Leaves by their score, best first.
class Search {
 public:
  Search(const Windows& windows, const std::vector<Turned>& headings, int half, int most_scored)
      : windows_(windows), headings_(headings), half_(half), left_(most_scored) {
    const int widest = 1 << (kLevels - 1);
    for (int angle = 0; angle < static_cast<int>(headings.size()); ++angle)
      for (int y = -half; y <= half; y += widest)
        for (int x = -half; x <= half; x += widest) push(kLevels - 1, angle, {x, y});
  }

  /// None where it runs out: whether another is better is not known then.
  [[nodiscard]] std::vector<Node> best(int kept) {
    std::vector<Node> taken;
    while (!open_.empty() && left_ > 0 && std::ssize(taken) < kept) {
      const Node node = open_.top();
      open_.pop();
      if (node.level > 0)
        split(node);
      else if (std::none_of(taken.begin(), taken.end(),
                            [&](const Node& other) { return beside(node, other); }))
        taken.push_back(node);
    }
    if (left_ <= 0) taken.clear();
    return taken;
  }

 private:
  static bool beside(const Node& a, const Node& b) {
    return (a.shift - b.shift).cwiseAbs().maxCoeff() <= kApart &&
           std::abs(a.angle - b.angle) <= kApart;
  }

  void split(const Node& node) {
    const int half = 1 << (node.level - 1);
    for (const Cell& to : {Cell(0, 0), Cell(half, 0), Cell(0, half), Cell(half, half)})
      push(node.level - 1, node.angle, node.shift + to);
  }

  void push(int level, int angle, const Cell& shift) {
    if (shift.maxCoeff() > half_ || left_ <= 0) return;
    --left_;
    const Turned& heading = headings_[static_cast<std::size_t>(angle)];
    open_.push({heading.score(windows_, level, shift), level, angle, shift});
  }

  const Windows& windows_;
  const std::vector<Turned>& headings_;
  int half_;
  int left_;  // windows that may still be scored
  std::priority_queue<Node> open_;
};

}  // namespace

std::vector<SE3> ColumnSearch::starts(std::span<const Eigen::Vector3d> points,
                                      const PosePrior& prior, const VoxelMap& map) const {
  const double cell_m = map.voxel_m();
  const SE3& T = prior.T_odom_lidar;
  const Reach reach = reach_of(prior, config_);
  Columns of_map(cell_m), of_scan(cell_m);
  for (const Eigen::Vector3d& p : points) of_scan.add(T.linear() * p);
  const std::vector<Eigen::Vector2d> here =
      every_nth(of_scan.places(config_.height_m), config_.columns);
  if (here.empty() || !std::isfinite(reach.place_m + reach.heading_rad)) return {};
  map.each_voxel([&](const Eigen::Vector3d& mean) { of_map.add(mean); });
  const std::vector<Eigen::Vector2d> there = of_map.places(config_.height_m);
  if (there.empty()) return {};

  const Windows windows(there, cell_m);
  const std::vector<Turned> headings = turned(here, T, reach.heading_rad, cell_m);
  const int half = static_cast<int>(std::ceil(reach.place_m / cell_m));
  Search search(windows, headings, half, config_.most_scored);
  std::vector<SE3> starts;
  for (const Node& node : search.best(config_.kept)) {
    SE3& start = starts.emplace_back(T);
    const double turn = headings[static_cast<std::size_t>(node.angle)].radians;
    start.linear() = Eigen::AngleAxisd(turn, Eigen::Vector3d::UnitZ()) * T.linear();
    start.translation().head<2>() += cell_m * node.shift.cast<double>();
  }
  return starts;
}

}  // namespace saker::odometry
