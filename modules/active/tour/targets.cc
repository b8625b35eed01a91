#include "saker/active/tour/targets.h"

#include <algorithm>
#include <limits>
#include <variant>

#include "saker/core/error.h"
#include "saker/objects/assignment.h"
#include "saker/objects/measurement.h"

namespace saker::active {
namespace {

using objects::Cuboid;
using objects::MapObject;

constexpr Eigen::Index kCuboidRows = 9;  // of a covariance: [rotation, translation, size]
constexpr Eigen::Index kLengthRow = 6;
constexpr double kNever = std::numeric_limits<double>::infinity();

Eigen::Vector3d size_of(const objects::ObjectClass& c) {
  if (c.size_m.size() != 3) {
    throw Error("objects.classes, size_m of " + c.name + ": " + std::to_string(c.size_m.size()) +
                " numbers, expected length, width and height");
  }
  return Eigen::Vector3d(c.size_m.data());
}

/// What an object occupies; a cylinder as the upright cuboid around it.
Cuboid cuboid_of(const objects::Model& model) {
  if (const auto* cuboid = std::get_if<Cuboid>(&model)) return *cuboid;
  const auto& cylinder = std::get<objects::Cylinder>(model);
  Cuboid around;
  around.size = {2 * cylinder.radius, 2 * cylinder.radius, cylinder.height};
  around.pose.translation() = cylinder.root + 0.5 * cylinder.height * Eigen::Vector3d::UnitZ();
  return around;
}

/// Of [x, y, length, width] or [x, y]; empty where the map does not say.
Covariance planar(const MapObject& object) {
  const std::vector<int> rows = objects::planar_rows(object.model);
  if (object.covariance.rows() <= rows.back() || !object.covariance.allFinite()) return {};
  return object.covariance(rows, rows);
}

std::string name_of(const MapObject& object) {
  return "prior map, object " + std::to_string(object.id) + ": ";
}

/// A prior knows the place roughly, the size perhaps and the heading not at all: a square that
/// holds the target however it is turned about z, in steps of a right angle.
Cuboid prior_extent(const MapObject& object, const objects::ObjectClass& object_class,
                    const TargetsConfig& config) {
  Cuboid extent = cuboid_of(object.model);
  extent.pose.linear().setIdentity();
  if (!objects::place(object.model).allFinite()) {
    throw Error(name_of(object) + "its place is not finite, expected three numbers");
  }
  const Eigen::Vector3d size = size_of(object_class);
  if (!extent.pose.matrix().allFinite()) extent.pose.translation() = objects::place(object.model);
  for (int axis = 0; axis < 3; ++axis) {
    if (!(extent.size[axis] > 0 && std::isfinite(extent.size[axis])))
      extent.size[axis] = size[axis];
  }
  extent.size.head<2>().setConstant(extent.size.head<2>().maxCoeff() + 2 * config.prior_margin_m);
  return extent;
}

/// Whether a map says how good its length and width are (one that other robots made), and they are.
bool is_known(const MapObject& object, double known_sd_m) {
  if (!std::holds_alternative<Cuboid>(object.model) || object.covariance.rows() < kCuboidRows) {
    return false;
  }
  const double variance = object.covariance.diagonal().segment<2>(kLengthRow).maxCoeff();
  return variance <= known_sd_m * known_sd_m;
}

bool is_target(const objects::ClassTable& table, objects::ClassId id) {
  return id < table.size() && table[id].target;
}

}  // namespace

TargetList::TargetList(const TargetsConfig& config, const objects::ClassTable& table,
                       const objects::ObjectMap& prior)
    : config_(config), table_(table) {
  for (const MapObject& object : prior.objects) {
    next_id_ = std::max(next_id_, object.id + 1);
    if (!is_target(table, object.class_id)) continue;
    Target& target = targets_.emplace_back();
    target.id = object.id;
    target.class_id = object.class_id;
    target.extent = target.expected = prior_extent(object, table[object.class_id], config);
    target.prior_place = target.expected_place();
    if (!is_known(object, config.known_sd_m)) continue;
    target.status = TargetStatus::visited;
    target.reason = "known well beforehand";
  }
  std::stable_sort(targets_.begin(), targets_.end(),
                   [](const Target& a, const Target& b) { return a.id < b.id; });
  const auto twice = std::adjacent_find(targets_.begin(), targets_.end(),
                                        [](auto& a, auto& b) { return a.id == b.id; });
  if (twice != targets_.end()) {
    throw Error("prior map: the id " + std::to_string(twice->id) + " occurs twice");
  }
  if (size() > config.most_targets) {
    throw Error("prior map: " + std::to_string(size()) + " targets, expected at most " +
                std::to_string(config.most_targets) + " (active.targets.most_targets)");
  }
}

double TargetList::distance(const Target& target, const MapObject& object) const {
  if (target.absent || object.class_id != target.class_id) return kNever;
  if (target.status == TargetStatus::unreachable && !target.mapped()) return kNever;
  const Cuboid mapped = cuboid_of(object.model);
  const Eigen::Vector3d between = mapped.pose.translation() - target.expected_place();
  if (!mapped.pose.matrix().allFinite() || !mapped.size.allFinite()) return kNever;
  if (std::abs(between.z()) > config_.height_gate_m) return kNever;
  const bool its_own = object.id == target.object_id;
  const double distance = between.head<2>().norm();
  if (distance > (target.stood && !its_own ? config_.stood_gate_m : config_.gate_m)) return kNever;
  return its_own ? std::max(distance - config_.keep_m, 0.0) : distance;
}

/// Of target and object in x-y; those that cannot be the same never are.
Eigen::MatrixXd TargetList::costs(const std::vector<const MapObject*>& objects) const {
  Eigen::MatrixXd cost(size(), static_cast<Eigen::Index>(objects.size()));
  for (int t = 0; t < size(); ++t) {
    for (Eigen::Index o = 0; o < cost.cols(); ++o) cost(t, o) = distance(targets_[t], *objects[o]);
  }
  for (int t = 0; t < size(); ++t) {
    if (targets_[t].status == TargetStatus::pending) continue;
    for (Eigen::Index o = 0; o < cost.cols(); ++o) {
      if (objects[o]->id != targets_[t].object_id || cost(t, o) == kNever) continue;
      cost.row(t).setConstant(kNever);
      cost.col(o).setConstant(kNever);
      cost(t, o) = 0;
    }
  }
  return cost;
}

void TargetList::associate(const objects::ObjectMap& map) {
  std::vector<const MapObject*> objects;
  for (const MapObject& object : map.objects) objects.push_back(&object);
  for (const MapObject& object : map.incomplete) objects.push_back(&object);
  const std::vector<int> object_of = objects::assign(costs(objects), config_.gate_m);
  for (int t = 0; t < size(); ++t) {
    const int o = object_of[t];
    attach(t, o < 0 ? nullptr : objects[o], o < static_cast<int>(map.objects.size()));
  }
}

void TargetList::attach(int index, const MapObject* object, bool complete) {
  Target& target = targets_[index];
  const bool mapped = object && complete;
  target.object_id = mapped ? object->id : -1;
  target.incomplete_id = object && !complete ? object->id : -1;
  target.covariance = mapped ? planar(*object) : Covariance();
  target.extent = object ? cuboid_of(object->model) : target.expected;
  if (target.status == TargetStatus::done || target.status == TargetStatus::visited) {
    target.status = mapped ? TargetStatus::done : TargetStatus::visited;
  }
}

void TargetList::close(int index, TargetStatus status, std::string reason) {
  Target& target = targets_[index];
  target.status = status;
  target.reason = std::move(reason);
  if (!target.mapped()) return;
  target.stood = true;
  target.expected.pose.translation() = target.place();
}

int TargetList::add(const MapObject& object, bool complete) {
  Target& target = targets_.emplace_back();
  target.id = next_id_++;
  target.class_id = object.class_id;
  target.discovered = true;
  target.expected = prior_extent(object, table_[object.class_id], config_);
  target.prior_place = target.expected_place();
  attach(size() - 1, &object, complete);
  ++revision_;
  return size() - 1;
}

void TargetList::dismiss(int index, std::string reason) {
  close(index, TargetStatus::visited, std::move(reason));
  targets_[index].absent = true;
  ++revision_;
}

int TargetList::count(TargetStatus status) const {
  return static_cast<int>(std::count_if(targets_.begin(), targets_.end(),
                                        [&](const Target& t) { return t.status == status; }));
}

}  // namespace saker::active
