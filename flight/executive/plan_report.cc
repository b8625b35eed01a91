#include "flight/executive/plan_report.h"

#include <algorithm>

namespace saker::flight {
namespace {

constexpr std::size_t kMost = plan_t::MAX_CANDIDATES;

candidate_t to_lcm(const active::ViewpointCandidate& candidate) {
  candidate_t message{};
  message.target_id = candidate.viewpoint.target_id;
  for (int i = 0; i < 3; ++i)
    message.position[i] = static_cast<float>(candidate.viewpoint.position(i));
  message.yaw = static_cast<float>(candidate.viewpoint.yaw);
  message.gain = static_cast<float>(candidate.gain);
  message.path_m = static_cast<float>(candidate.cost_m);
  return message;
}

/// Of one that is refused neither gain nor way says anything: the gain's place has the reason.
candidate_t to_lcm_refused(const active::ViewpointCandidate& candidate) {
  candidate_t message = to_lcm(candidate);
  message.gain = -static_cast<float>(candidate.refusal);
  message.path_m = NAN;
  return message;
}

}  // namespace

void write_candidates(const active::ActivePlan& plan, plan_t& message) {
  message.choice = -1;
  message.candidates.clear();
  const auto is_chosen = [&](const active::ViewpointCandidate& candidate) {
    return plan.goal && candidate.viewpoint.id == plan.goal->id;
  };
  const auto is_refused = [&](const active::ViewpointCandidate& candidate) {
    return candidate.refusal != active::Refusal::none && !is_chosen(candidate);
  };
  std::size_t refused = 0;
  for (const active::ViewpointCandidate& candidate : plan.candidates) {
    if (is_refused(candidate)) ++refused;
    if (is_refused(candidate) || message.candidates.size() == kMost) continue;
    if (is_chosen(candidate)) message.choice = static_cast<int>(message.candidates.size());
    message.candidates.push_back(to_lcm(candidate));
  }
  const std::size_t room = std::min(kMost - message.candidates.size(), refused);
  std::size_t seen = 0;
  for (const active::ViewpointCandidate& candidate : plan.candidates) {
    if (!is_refused(candidate)) continue;
    // The k-th of n is one of m where k m / n passes a whole number.
    if ((seen + 1) * room / refused > seen * room / refused)
      message.candidates.push_back(to_lcm_refused(candidate));
    ++seen;
  }
  message.num_candidates = static_cast<std::int32_t>(message.candidates.size());
}

}  // namespace saker::flight
