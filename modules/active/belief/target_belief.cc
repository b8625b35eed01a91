#include "saker/active/belief/target_belief.h"

#include <cmath>

namespace saker::active {

TargetBelief::TargetBelief(const Target& target, const MappedViewHistory& history,
                           const ViewModel& model, const PamsConfig& config)
    : target_(target),
      history_(history),
      model_(model),
      config_(config),
      by_views_(target, history.so_far(), model, config) {}

Belief TargetBelief::belief() const {
  if (!config_.map_counts || target_.covariance.size() == 0) return by_views_.belief();
  const Belief map = in_map(history_.so_far());
  return map.entropy() > by_views_.belief().entropy() ? map : by_views_.belief();
}

Belief TargetBelief::in_map(const ViewHistory& until) const {
  return map_belief(target_, history_.in_map(), until, model_, config_);
}

bool TargetBelief::size_is_known(double share) const {
  if (model_.common(target_.class_id).rows() < 4) return true;
  const bool map_says = target_.covariance.size() != 0;
  const Belief belief = map_says ? in_map(history_.so_far()) : by_views_.belief();
  const Eigen::Vector2d variances = belief.covariance().diagonal().tail<2>();
  return std::sqrt(variances.maxCoeff()) <= share * config_.most_size_sd_m;
}

bool TargetBelief::is_enough(const objects::ObjectMap* map) const {
  return belief().entropy() <= config_.enough_entropy && size_is_known(1) &&
         class_probability(map) >= config_.least_probability;
}

/// Of the mapped object's class; 1 where the map does not say.
double TargetBelief::class_probability(const objects::ObjectMap* map) const {
  if (!map) return 1;
  for (const objects::MapObject& object : map->objects) {
    if (object.id != target_.object_id) continue;
    const std::vector<double>& probability = object.class_probability;
    return target_.class_id < probability.size() ? probability[target_.class_id] : 1;
  }
  return 1;
}

}  // namespace saker::active
