#include "saker/active/active.h"

#include <utility>

#include "saker/active/belief/view_model.h"
#include "saker/active/views/pams_chooser.h"
#include "saker/active/views/visit_chooser.h"
#include "saker/core/error.h"

namespace saker::active {
namespace {

std::unique_ptr<const ViewChooser> make_chooser(const ActiveConfig& config,
                                                const objects::ClassTable& table,
                                                const ViewpointSampler& sampler,
                                                std::shared_ptr<const uncertainty::Model> model,
                                                const motion::LimitsConfig& limits) {
  if (config.policy == PolicyName::visit) {
    return std::make_unique<VisitChooser>(config.visit_policy, sampler);
  }
  if (!model) throw Error("active.policy: paper and saker need an uncertainty model, found none");
  return std::make_unique<PamsChooser>(pams_of(config), config.visit_policy, sampler,
                                       view_model_of(std::move(model), config.region, table),
                                       limits);
}

bool is_swept(const SweepConfig& config, const std::vector<Target>& targets) {
  return config.when == SweepWhen::always ||
         (config.when == SweepWhen::without_prior && without_prior(targets));
}

}  // namespace

TargetTour make_tour(const ActiveConfig& config, const objects::ClassTable& table,
                     const objects::ObjectMap& prior, InGeofence in_geofence,
                     std::shared_ptr<const uncertainty::Model> model,
                     const motion::LimitsConfig& limits) {
  const ActiveConfig valid = checked(config);
  TargetList targets(valid.targets, table, prior);
  const ViewpointSampler sampler(valid.viewpoints, valid.view, std::move(in_geofence));
  auto chooser = make_chooser(valid, table, sampler, std::move(model), limits);
  return {valid, std::move(targets), sampler, std::move(chooser)};
}

Active::Active(const ActiveConfig& config, const objects::ClassTable& table,
               const objects::ObjectMap& prior, const motion::Geofence& fence,
               std::shared_ptr<const uncertainty::Model> model, const motion::LimitsConfig& limits)
    : tour_(make_tour(
          config, table, prior, [fence](const Eigen::Vector3d& p) { return fence.contains(p); },
          std::move(model), limits)),
      discovery_(config, table, fence) {
  if (is_swept(config.discovery.sweep, targets())) sweep_.emplace(config, fence);
}

ActivePlan Active::plan(const ActiveInput& input, const core::Budget& budget) {
  if (!input.T_world_odom.matrix().allFinite()) return {};
  if (!vehicle_.advance(input.stamp, input.T_world_body)) return {};
  const OccupancyView block{input.grid.get(), input.T_world_odom.inverse()};
  discovery_.update(vehicle_, input.map.get(), block, tour_.target_list());
  if (sweep_) sweep_->observe(vehicle_, block, input.map.get());
  ActivePlan plan = tour_.plan(input, budget);
  if (!sweep_) return plan;
  if (plan.status == ActiveStatus::finished) {
    plan.goal = sweep_->next(vehicle_, block, input.map.get());
    if (plan.goal) plan.status = ActiveStatus::flying;
  } else {
    sweep_->leave();
  }
  plan.seen_share = sweep_->seen_share();
  return plan;
}

void Active::refuse(int viewpoint_id, const std::string& reason) {
  if (!sweep_ || !sweep_->refuse(viewpoint_id)) tour_.refuse(viewpoint_id, reason);
}

}  // namespace saker::active
