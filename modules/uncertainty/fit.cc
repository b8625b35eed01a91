#include "saker/uncertainty/fit.h"

#include <fmt/format.h>

#include <map>
#include <set>

#include "saker/core/error.h"

namespace saker::uncertainty {
namespace {

/// Counts; throws Error where they are too few.
ClassModel counted(std::span<const Sample> samples, const std::string& name, int least_objects) {
  std::set<std::string> recordings;
  std::set<std::pair<std::string, int>> objects;
  for (const Sample& sample : samples) {
    recordings.insert(sample.recording);
    objects.emplace(sample.recording, sample.object_id);
  }
  ClassModel model;
  model.recordings = static_cast<int>(recordings.size());
  model.objects = static_cast<int>(objects.size());
  model.samples = static_cast<int>(samples.size());
  if (model.objects < least_objects || model.recordings < 2) {
    throw Error(
        fmt::format("samples of class {}: {} objects in {} recordings, expected at least "
                    "{} in 2",
                    name, model.objects, model.recordings, least_objects));
  }
  return model;
}

void check_edges(const std::vector<double>& edges) {
  bool ascending = edges.size() >= 2;
  for (std::size_t i = 1; i < edges.size(); ++i) ascending = ascending && edges[i] > edges[i - 1];
  if (!ascending) throw Error("fit.range_edges_m: expected at least two ascending ranges");
}

}  // namespace

std::vector<ClassModel> fit(std::span<const Sample> samples, const objects::ClassTable& table,
                            const FitConfig& config, std::uint64_t seed) {
  const FitConfig used = core::checked(config, "fit");
  check_edges(used.range_edges_m);
  std::map<objects::ClassId, std::vector<Sample>> by_class;
  for (const Sample& sample : samples) by_class[sample.class_id].push_back(sample);
  if (by_class.empty()) throw Error("no samples");
  std::vector<ClassModel> models;
  for (const auto& [id, own] : by_class) {
    ClassModel model = counted(own, table[id].name, used.least_objects);
    model.id = id;
    const bool cuboid = table[id].shape == objects::Shape::cuboid;
    FitConfig of_class = used;
    of_class.errors.about_truth = cuboid && !used.cuboid_bias;
    model.semantic = fit_semantic(own, used, seed, model.trials);
    model.geometric =
        fit_geometric(own, {used.range_edges_m, cuboid ? used.sectors : 1}, of_class, model.trials);
    models.push_back(std::move(model));
  }
  return models;
}

}  // namespace saker::uncertainty
