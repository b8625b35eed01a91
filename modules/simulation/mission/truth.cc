#include "saker/simulation/mission/truth.h"

#include <cstdio>

namespace saker::simulation {

SE3 levelled(const SE3& T) {
  const Eigen::Vector3d& p = T.translation();
  return placed(p.x(), p.y(), p.z(), core::yaw(T.linear()));
}

std::string tum_row(Time stamp, const SE3& T) {
  const Eigen::Quaterniond q(T.linear());
  const Eigen::Vector3d& p = T.translation();
  char line[256];
  std::snprintf(line, sizeof(line), "%.9f %.6f %.6f %.6f %.9f %.9f %.9f %.9f\n", to_seconds(stamp),
                p.x(), p.y(), p.z(), q.x(), q.y(), q.z(), q.w());
  return line;
}

objects::ObjectMap truth_map(const World& world, const SE3& T_world_sim,
                             const std::vector<int>& hits) {
  const objects::ClassTable table;
  objects::ObjectMap map;
  for (std::size_t i = 0; i < world.objects.size(); ++i) {
    const TrueObject& object = world.objects[i];
    if (object.moving) continue;
    objects::MapObject entry;
    entry.id = static_cast<int>(i + 1);
    entry.class_id = table.find(object.class_name);
    entry.class_probability.assign(table.size(), 0);
    entry.class_probability[entry.class_id] = 1;
    entry.model = objects::transformed(T_world_sim, object.model);
    entry.points = hits[i + 1];
    map.objects.push_back(std::move(entry));
  }
  return map;
}

void count_hits(const World& world, const CastScan& scan, std::vector<int>& hits) {
  const objects::ClassTable table;
  for (std::size_t i = 0; i < scan.objects.size(); ++i) {
    if (scan.range_m[i] <= 0 || scan.objects[i] == 0) continue;
    const std::string& of = world.objects[scan.objects[i] - 1].class_name;
    hits[scan.objects[i]] += table[table.of_label(scan.labels[i])].name == of;
  }
}

}  // namespace saker::simulation
