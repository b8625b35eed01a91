#include "detection/surroundings.h"

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
    if (height < config_.lowest_m || height > config_.highest_m) continue;
    cells_.push_back({key(cell_of(point.x()), cell_of(point.y())), point.head<2>()});
  }
  std::ranges::sort(cells_, {}, &Cell::key);
}

int Surroundings::count(const Eigen::Vector2f& foot, double radius) const {
  const auto inner = static_cast<float>(radius + config_.gap_m);
  const auto outer = static_cast<float>(radius + config_.gap_m + config_.width_m);
  int found = 0;
  for (int x = cell_of(foot.x() - outer); x <= cell_of(foot.x() + outer); ++x) {
    for (int y = cell_of(foot.y() - outer); y <= cell_of(foot.y() + outer); ++y) {
      const auto [first, last] = std::ranges::equal_range(cells_, key(x, y), {}, &Cell::key);
      found += static_cast<int>(std::count_if(first, last, [&](const Cell& cell) {
        const float distance = (cell.place - foot).norm();
        return distance > inner && distance < outer;
      }));
    }
  }
  return found * stride_;
}

}  // namespace saker::detection
