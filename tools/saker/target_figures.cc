#include "saker/target_figures.h"

#include <algorithm>
#include <cmath>

#include "core/statistics.h"
#include "objects/comparison.h"

namespace saker::tools {
namespace {

const objects::MapObject& by_id(const objects::ObjectMap& map, int id) {
  return *std::ranges::find(map.objects, id, &objects::MapObject::id);
}

}  // namespace

Json number(double value) { return std::isfinite(value) ? Json(value) : Json(); }

Json target_figures(const objects::ObjectMap& mapped, const objects::ObjectMap& truth,
                    const std::vector<int>& targets, const objects::ClassTable& table) {
  std::vector<double> errors;
  Json list = Json::array();
  for (const objects::ClassComparison& c : objects::compare(mapped, truth, table, {})) {
    if (c.shape != objects::Shape::cuboid) continue;
    for (const auto& [mapped_id, true_id] : c.pairs) {
      if (std::ranges::find(targets, true_id) == targets.end()) continue;
      const auto& found = std::get<objects::Cuboid>(by_id(mapped, mapped_id).model);
      const auto& real = std::get<objects::Cuboid>(by_id(truth, true_id).model);
      const Eigen::Vector3d error = found.size - real.size;
      const Eigen::Vector3d away = found.pose.translation() - real.pose.translation();
      errors.insert(errors.end(), {error.x(), error.y()});
      list.push_back({{"id", true_id},
                      {"length_m", error.x()},
                      {"width_m", error.y()},
                      {"distance_m", away.head<2>().norm()}});
    }
  }
  return {{"targets", targets.size()},
          {"found", list.size()},
          {"bias_m", number(core::mean(errors))},
          {"sd_m", number(core::standard_deviation(errors))},
          {"mae_m", number(core::mean_absolute(errors))},
          {"errors", list}};
}

}  // namespace saker::tools
