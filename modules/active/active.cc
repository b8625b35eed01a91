#include "active/active.h"

#include "active/visit.h"
#include "core/error.h"

namespace saker::active {
namespace {

ActiveConfig checked_config(const ActiveConfig& config) {
  const ActiveConfig valid = core::checked(config, "active");
  const VisitConfig& visit = valid.visit_policy;
  if (visit.sides > 1 && visit.separation_deg > 180.0 / (visit.sides - 1)) {
    throw Error("active.visit.separation_deg: " + std::to_string(visit.separation_deg) +
                ", expected at most 180 / (sides - 1), or a side may find no room");
  }
  if (valid.goals.standing_s <= 2 * visit.dwell_s) {
    throw Error("active.goals.standing_s: " + std::to_string(valid.goals.standing_s) +
                ", expected more than two dwells (active.visit.dwell_s), or no side is ever seen");
  }
  const FieldOfViewConfig& view = valid.view;
  if (view.nearest_m >= view.farthest_m) {
    throw Error("active.view.nearest_m: " + std::to_string(view.nearest_m) +
                ", expected less than farthest_m");
  }
  return valid;
}

}  // namespace

std::unique_ptr<TargetPolicy> make_policy(const ActiveConfig& config,
                                          const objects::ClassTable& table,
                                          const objects::ObjectMap& prior, InGeofence in_geofence) {
  const ActiveConfig valid = checked_config(config);
  TargetList targets(valid.targets, table, prior);
  switch (valid.policy) {
    case PolicyName::visit:
      return std::make_unique<VisitPolicy>(valid, std::move(targets), std::move(in_geofence));
  }
  throw Error("active.policy: no such policy");
}

}  // namespace saker::active
