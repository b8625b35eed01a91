#include "saker/detection/surroundings.h"

#include <algorithm>
#include <cmath>

namespace saker::detection {
namespace {

constexpr float kCell_m = 1;  // larger than the rings: two cells a side hold one

}  // namespace

std::int64_t Surroundings::key(int x, int y) { return (static_cast<std::int64_t>(x) << 32) + y; }

int Surroundings::cell_of(float v) const { return static_cast<int>(std::floor(v / kCell_m)); }

void Surroundings::fill(std::span<const Eigen::Vector3f> others, int stride, const Ground& ground) {
  stride_ = stride;
  cells_.clear();
  for (const Eigen::Vector3f& point : others) {
    const Eigen::Vector3d p = point.cast<double>();
    const objects::GroundPlane* plane = ground.at(p);
    if (plane == nullptr) continue;
    const double height = plane->height_of(p);
    if (height < config_.lowest_m || height > config_.crown_highest_m) continue;
    cells_.push_back(
        {key(cell_of(point.x()), cell_of(point.y())), point.head<2>(), static_cast<float>(height)});
  }
  std::ranges::sort(cells_, {}, &Cell::key);
}

template <class Predicate>
int Surroundings::count_if(const Eigen::Vector2f& middle, float reach, Predicate counts) const {
  int found = 0;
  for (int x = cell_of(middle.x() - reach); x <= cell_of(middle.x() + reach); ++x) {
    for (int y = cell_of(middle.y() - reach); y <= cell_of(middle.y() + reach); ++y) {
      const auto [first, last] = std::ranges::equal_range(cells_, key(x, y), {}, &Cell::key);
      found += static_cast<int>(std::count_if(first, last, counts));
    }
  }
  return found * stride_;
}

template <class Predicate>
int Surroundings::count_low(const Eigen::Vector2f& middle, float reach, Predicate counts) const {
  const auto highest = static_cast<float>(config_.highest_m);
  return count_if(middle, reach,
                  [&](const Cell& cell) { return cell.height <= highest && counts(cell.place); });
}

int Surroundings::around(const Eigen::Vector2f& foot, double radius) const {
  const auto inner = static_cast<float>(radius + config_.gap_m);
  const auto outer = static_cast<float>(inner + config_.width_m);
  return count_low(foot, outer, [&](const Eigen::Vector2f& place) {
    const float distance = (place - foot).norm();
    return distance > inner && distance < outer;
  });
}

int Surroundings::inside(const objects::Cylinder& cylinder) const {
  const Eigen::Vector2f foot = cylinder.root.head<2>().cast<float>();
  const auto reach = static_cast<float>(cylinder.radius + config_.gap_m);
  return count_low(foot, reach,
                   [&](const Eigen::Vector2f& p) { return (p - foot).norm() < reach; });
}

int Surroundings::inside(const objects::Cuboid& cuboid) const {
  const Eigen::Vector2f middle = cuboid.pose.translation().head<2>().cast<float>();
  const Eigen::Vector2f ahead = cuboid.pose.linear().col(0).head<2>().cast<float>().normalized();
  const Eigen::Vector2f left(-ahead.y(), ahead.x());
  const Eigen::Vector2f half = 0.5f * cuboid.size.head<2>().cast<float>();
  return count_low(middle, half.norm(), [&](const Eigen::Vector2f& p) {
    return std::abs(ahead.dot(p - middle)) < half.x() && std::abs(left.dot(p - middle)) < half.y();
  });
}

double Surroundings::crown_odds(const objects::Cylinder& cylinder, int own) const {
  const Eigen::Vector2f foot = cylinder.root.head<2>().cast<float>();
  const auto lowest = static_cast<float>(config_.highest_m);
  const auto reach = static_cast<float>(config_.crown_reach_m);
  const int leaves = count_if(foot, reach, [&](const Cell& cell) {
    return cell.height > lowest && (cell.place - foot).norm() < reach;
  });
  const double share = static_cast<double>(leaves) / std::max(own, 1);
  if (share < config_.bare_share) return 1 / config_.bare_odds;
  return share > config_.leafy_share ? config_.leafy_odds : 1;
}

}  // namespace saker::detection
