#include "saker/active/belief/view_model.h"

#include <map>
#include <utility>

#include "saker/core/error.h"

namespace saker::active {

ViewModel view_model_of(std::shared_ptr<const uncertainty::Model> model,
                        const uncertainty::RegionConfig& config, const objects::ClassTable& table) {
  auto regions = std::make_shared<std::map<objects::ClassId, uncertainty::Regions>>();
  for (int i = 0; i < table.size(); ++i) {
    const auto id = static_cast<objects::ClassId>(i);
    if (!table[id].target) continue;
    if (!model->knows(id)) {
      throw Error("active.policy: the uncertainty model does not know the target class '" +
                  table[id].name + "'; fit it, or take policy visit");
    }
    regions->emplace(id, uncertainty::Regions(config, *model, id));
  }
  ViewModel view_model;
  view_model.predict = [model](objects::ClassId id, const uncertainty::View& view) {
    return model->predict(id, view);
  };
  view_model.common = [model](objects::ClassId id) { return model->common_covariance(id); };
  view_model.in_region = [model, regions](objects::ClassId id, const uncertainty::View& view) {
    return regions->at(id).contains(view);
  };
  return view_model;
}

}  // namespace saker::active
