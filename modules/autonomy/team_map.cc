#include "saker/autonomy/team_map.h"

#include <algorithm>
#include <map>

#include "saker/objects/comparison.h"

namespace saker::autonomy {
namespace {

bool is_target(const objects::MapObject& object, const objects::ClassTable& table) {
  return object.class_id < table.size() && table[object.class_id].target;
}

/// Id of what was said beforehand → the mapped object that it is.
std::map<int, int> mapped_of(const objects::ObjectMap& said, const objects::ObjectMap& mapped,
                             double gate_m, const objects::ClassTable& table) {
  std::map<int, int> ids;
  const objects::ComparisonOptions options{.cuboid_gate_m = gate_m, .cylinder_gate_m = gate_m};
  for (const auto& of_class : objects::compare(mapped, said, table, options)) {
    for (const objects::FoundPair& pair : of_class.pairs) ids[pair.truth] = pair.mapped;
  }
  return ids;
}

int next_id(const objects::ObjectMap& map) {
  int id = 0;
  for (const objects::MapObject& object : map.objects) id = std::max(id, object.id + 1);
  return id;
}

}  // namespace

objects::ObjectMap in_frame(const std::string& frame, const SE3& T_frame_map,
                            const objects::ObjectMap& map) {
  objects::ObjectMap seen = map;
  seen.frame = frame;
  for (auto* objects : {&seen.objects, &seen.incomplete}) {
    for (objects::MapObject& object : *objects)
      object.model = objects::transformed(T_frame_map, object.model);
  }
  for (objects::GroundPlane& plane : seen.ground) plane = objects::transformed(T_frame_map, plane);
  return seen;
}

std::vector<double> in_frame(const SE3& T_frame_map, const std::vector<double>& corners_m) {
  std::vector<double> seen;
  for (std::size_t i = 0; i + 1 < corners_m.size(); i += 2) {
    const Eigen::Vector3d corner = T_frame_map * Eigen::Vector3d(corners_m[i], corners_m[i + 1], 0);
    seen.insert(seen.end(), {corner.x(), corner.y()});
  }
  return seen;
}

Lot::Lot(const std::vector<double>& corners_m) {
  if (!corners_m.empty()) outline_.emplace(motion::GeofenceConfig{.polygon_m = corners_m});
}

bool Lot::contains(const Eigen::Vector3d& place) const {
  return !outline_ || outline_->inside_polygon_m(place.head<2>()) >= 0;
}

objects::ObjectMap next_prior(const objects::ObjectMap& said, const objects::ObjectMap& mapped,
                              const Lot& lot, double gate_m, const objects::ClassTable& table) {
  const std::map<int, int> mapped_as = mapped_of(said, mapped, gate_m, table);
  objects::ObjectMap prior;
  prior.frame = said.frame;
  std::map<int, const objects::MapObject*> known;  // mapped id → what was said of it
  for (const objects::MapObject& object : said.objects) {
    const auto as = mapped_as.find(object.id);
    if (as != mapped_as.end()) {
      known[as->second] = &object;
    } else if (lot.contains(objects::place(object.model))) {
      prior.objects.push_back(object);
    }
  }
  int unused = next_id(said);
  for (objects::MapObject object : mapped.objects) {
    const auto as = known.find(object.id);
    const bool was_said = as != known.end();
    const objects::Model& where = was_said ? as->second->model : object.model;
    if (!is_target(object, table) || !lot.contains(objects::place(where))) continue;
    object.id = was_said ? as->second->id : unused++;
    prior.objects.push_back(std::move(object));
  }
  std::ranges::sort(prior.objects, {}, &objects::MapObject::id);
  return prior;
}

TeamPrior team_prior(const objects::ObjectMap& said, const objects::ObjectMap& mapped,
                     const Lot& lot, double gate_m, const active::TargetsConfig& config,
                     const objects::ClassTable& table) {
  TeamPrior result{.prior = next_prior(said, mapped, lot, gate_m, table)};
  const active::TargetList targets(config, table, result.prior);
  result.known = targets.size() - targets.count(active::TargetStatus::pending);
  for (const objects::MapObject& object : result.prior.objects)
    result.weak += object.covariance.size() > 0;
  result.weak -= result.known;
  result.mapped = static_cast<int>(mapped.objects.size());
  return result;
}

}  // namespace saker::autonomy
