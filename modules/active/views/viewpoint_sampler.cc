#include "saker/active/views/viewpoint_sampler.h"

#include <map>
#include <utility>

namespace saker::active {

ViewpointSampler::ViewpointSampler(const ViewpointConfig& config, const FieldOfViewConfig& view,
                                   InGeofence in_geofence)
    : config_(config), view_(view), in_geofence_(std::move(in_geofence)) {}

std::vector<ViewpointCandidate> ViewpointSampler::around(const Target& target, int index,
                                                         const OccupancyView& block) const {
  const int first_id = index * config_.bearings * config_.rings;
  std::vector<ViewpointCandidate> candidates =
      sample_viewpoints(target.extent, first_id, config_, view_, block, in_geofence_);
  for (ViewpointCandidate& candidate : candidates) candidate.viewpoint.target_id = target.id;
  return candidates;
}

ViewpointCandidate ViewpointSampler::goal(const Viewpoint& goal, const Target& target,
                                          const OccupancyView& block) const {
  FieldOfViewConfig view = view_;
  view.margin_deg /= 2;
  ViewpointCandidate candidate;
  candidate.viewpoint = goal;
  candidate.known_free = block.at(goal.position) == occupancy::Cell::free;
  candidate.refusal = refusal_of(goal, target.extent, config_, view, block, in_geofence_);
  return candidate;
}

bool ViewpointSampler::sees(const Eigen::Vector3d& eye, double yaw, const Target& target,
                            const OccupancyView& block, double margin_deg) const {
  return in_field_of_view(eye, yaw, target.extent, view_, margin_deg) &&
         visible_share(eye, target.extent, block, config_.own_margin_m) >= config_.least_visible;
}

std::string count_refusals(const std::vector<ViewpointCandidate>& candidates) {
  std::map<Refusal, int> count;
  for (const ViewpointCandidate& candidate : candidates) ++count[candidate.refusal];
  if (count.contains(Refusal::none)) return "too many viewpoints were flown to in vain";
  std::string text = "no viewpoint left:";
  for (const auto& [refusal, number] : count) {
    text += (text.back() == ':' ? " " : ", ") + std::to_string(number) + " " + to_string(refusal);
  }
  return text;
}

}  // namespace saker::active
