#include "tools/saker/experiment/target_figures.h"

#include <algorithm>
#include <cmath>

#include "saker/core/statistics.h"
#include "saker/objects/consistency.h"

namespace saker::tools {
namespace {

const objects::MapObject& by_id(const objects::ObjectMap& map, int id) {
  return *std::ranges::find(map.objects, id, &objects::MapObject::id);
}

}  // namespace

Json number(double value) { return std::isfinite(value) ? Json(value) : Json(); }

Json target_figures(const objects::ObjectMap& mapped, const objects::ObjectMap& truth,
                    const std::vector<int>& targets, const objects::ClassTable& table) {
  std::vector<double> errors, size_nees, place_nees;
  Json list = Json::array();
  const auto compared = objects::compare(mapped, truth, table, {});
  for (const objects::ObjectConsistency& object : objects::consistency(mapped, truth, compared)) {
    if (table[object.class_id].shape != objects::Shape::cuboid) continue;
    if (std::ranges::find(targets, object.ids.truth) == targets.end()) continue;
    const auto& found = std::get<objects::Cuboid>(by_id(mapped, object.ids.mapped).model);
    const auto& real = std::get<objects::Cuboid>(by_id(truth, object.ids.truth).model);
    const Eigen::Vector3d error = found.size - real.size;
    const Eigen::Vector3d away = found.pose.translation() - real.pose.translation();
    errors.insert(errors.end(), {error.x(), error.y()});
    if (std::isfinite(object.size)) size_nees.push_back(object.size);
    if (std::isfinite(object.place)) place_nees.push_back(object.place);
    list.push_back({{"id", object.ids.truth},
                    {"length_m", error.x()},
                    {"width_m", error.y()},
                    {"distance_m", away.head<2>().norm()},
                    {"size_nees", number(object.size)},
                    {"place_nees", number(object.place)}});
  }
  return {{"targets", targets.size()},
          {"found", list.size()},
          {"bias_m", number(core::mean(errors))},
          {"sd_m", number(core::standard_deviation(errors))},
          {"mae_m", number(core::mean_absolute(errors))},
          {"size_nees", number(core::mean(size_nees))},
          {"place_nees", number(core::mean(place_nees))},
          {"errors", list}};
}

Json consistency_figures(const objects::ObjectMap& mapped, const objects::ObjectMap& truth,
                         const objects::ClassTable& table) {
  const auto compared = objects::compare(mapped, truth, table, {});
  const auto judged = objects::consistency(mapped, truth, compared);
  Json figures = Json::object();
  for (const objects::ClassComparison& c : compared) {
    if (c.found == 0) continue;
    const auto mean = objects::mean_consistency(judged, table.find(c.name));
    figures[c.name] = {{"objects", mean.objects},
                       {"size_nees", number(mean.size)},
                       {"place_nees", number(mean.place)}};
  }
  return figures;
}

Json class_counts(const objects::ObjectMap& mapped, const objects::ObjectMap& truth,
                  const objects::ClassTable& table) {
  Json counts = Json::object();
  for (const objects::ClassComparison& c : objects::compare(mapped, truth, table, {})) {
    counts[c.name] = {{"mapped", c.mapped}, {"invented", c.invented}, {"duplicates", c.duplicates}};
  }
  return counts;
}

}  // namespace saker::tools
