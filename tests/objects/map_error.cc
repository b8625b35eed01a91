#include "map_error.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <unordered_map>

#include "saker/objects/object_numbers.h"

namespace saker::objects::made {
namespace {

constexpr double kGate_m = 1;

using Cells = std::unordered_multimap<std::int64_t, const MapObject*>;

std::int64_t cell_of(const Eigen::Vector3d& p) {
  return (std::llround(p.x() / kGate_m) << 32) + std::llround(p.y() / kGate_m);
}

const MapObject* nearest(const Cells& cells, const MapObject& object) {
  const Eigen::Vector3d at = place(object.model);
  const MapObject* best = nullptr;
  double distance = kGate_m;
  for (int i = -1; i <= 1; ++i)
    for (int j = -1; j <= 1; ++j) {
      const Eigen::Vector3d beside = at + kGate_m * Eigen::Vector3d(i, j, 0);
      const auto [first, last] = cells.equal_range(cell_of(beside));
      for (auto it = first; it != last; ++it) {
        const double d = (place(it->second->model) - at).norm();
        if (it->second->class_id != object.class_id || d >= distance) continue;
        distance = d;
        best = it->second;
      }
    }
  return best;
}

double angle(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  return std::atan2(a.cross(b).norm(), a.dot(b));
}

void grow(double& worst, double error) { worst = std::max(worst, std::abs(error)); }

void compare(const Cuboid& a, const Cuboid& b, MapError& worst) {
  grow(worst.size, (a.size - b.size).cwiseAbs().maxCoeff());
  const double turn = core::yaw(a.pose.linear()) - core::yaw(b.pose.linear());
  grow(worst.heading, std::atan2(std::sin(turn), std::cos(turn)));
  grow(worst.tilt, angle(a.pose.linear().col(2), b.pose.linear().col(2)));
}

void compare(const Cylinder& a, const Cylinder& b, MapError& worst) {
  grow(worst.radius, a.radius - b.radius);
  grow(worst.size, a.height - b.height);
  grow(worst.tilt, angle(a.axis, b.axis));
}

}  // namespace

MapError largest_error(const ObjectMap& a, const ObjectMap& b) {
  Cells cells;
  for (const MapObject& object : b.objects) {
    cells.emplace(cell_of(place(object.model)), &object);
  }
  MapError worst;
  for (const MapObject& object : a.objects) {
    const MapObject* other = nearest(cells, object);
    if (other == nullptr || a.objects.size() != b.objects.size()) {
      return {INFINITY, INFINITY, INFINITY, INFINITY, INFINITY, INFINITY};
    }
    grow(worst.position, (place(object.model) - place(other->model)).norm());
    grow(worst.probability, probability_of(object) - probability_of(*other));
    if (const auto* cuboid = std::get_if<Cuboid>(&object.model)) {
      compare(*cuboid, std::get<Cuboid>(other->model), worst);
    } else {
      compare(std::get<Cylinder>(object.model), std::get<Cylinder>(other->model), worst);
    }
  }
  return worst;
}

}  // namespace saker::objects::made
